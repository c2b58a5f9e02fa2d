// PFM files: a map of the size that it says, or a line.
#include <cstdlib>

#include "engine/io/pfm.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto& path = quorum::write_input({reinterpret_cast<const char*>(data), size}, ".pfm");
  const auto fits = [](const auto& map) {
    return map.width >= 0 && map.height >= 0 &&
           map.values.size() == static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  };
  if (const auto map = quorum::read_pfm(path); map && !fits(*map)) std::abort();
  if (const auto map = quorum::read_pfm_vectors(path); map && !fits(*map)) std::abort();
  return 0;
}
