// The first bytes of photographs, of all formats: a size, or a line.
#include <cstdlib>

#include "engine/io/image_size.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto header = quorum::read_image_size(quorum::write_input({reinterpret_cast<const char*>(data), size}, ".jpg"));
  if (header && (header->width <= 0 || header->height <= 0)) std::abort();
  return 0;
}
