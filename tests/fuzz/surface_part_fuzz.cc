// A shard's part of the surface: what was written, or a line. Fusion takes nothing else from another machine unread.
#include <cstdlib>

#include "engine/pipeline/surface_part.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto& path = quorum::write_input({reinterpret_cast<const char*>(data), size}, ".part");
  const std::string record = quorum::read_surface_record(path);
  const auto part = quorum::read_surface_part(path);
  if (part && part->record != record) std::abort();
  return 0;
}
