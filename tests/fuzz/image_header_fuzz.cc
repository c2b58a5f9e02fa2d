// The first bytes of photographs, of all formats: a size, or a line. JPEG files are looked through to their end.
#include <cstdlib>

#include "engine/io/image_size.h"
#include "engine/io/jpeg_flaw.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto header = quorum::read_image_size(quorum::write_input(bytes, ".jpg"));
  if (header && (header->width <= 0 || header->height <= 0)) std::abort();
  constexpr double kMostPixels = 1 << 24;  // of which a small file may tell, and which take long
  if (header && static_cast<double>(header->width) * header->height < kMostPixels) quorum::find_jpeg_flaw(bytes);
  return 0;
}
