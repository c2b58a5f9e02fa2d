// What all calls of the libraries that decode and encode images share: their errors, and silence while they work.
#pragma once

#include <exception>
#include <mutex>
#include <string_view>

#include "engine/core/error.h"

namespace quorum {

/// True while a library decodes or encodes an image. Some abort the process where memory runs out (GDAL). May be called
/// from a signal handler.
bool is_in_image_library();

/// While it lives, what libraries print on standard error is dropped: libpng tells of damage there, and we do so in our
/// own line. One at a time.
class LibraryAtWork {
 public:
  LibraryAtWork();
  ~LibraryAtWork();
  LibraryAtWork(const LibraryAtWork&) = delete;
  LibraryAtWork& operator=(const LibraryAtWork&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  int kept_;
};

/// kMemory: no memory is left to decode, or encode, an image.
Error no_image_memory(std::string_view what);

/// What an exception of a library that decodes means, on one line: kMemory, or kInput.
Error decoding_error(const std::exception& exception);

}  // namespace quorum
