#include "engine/io/image_library.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <opencv2/core.hpp>
#include <string>

#include "engine/core/option.h"

namespace quorum {
namespace {

std::atomic<bool> library_is_at_work = false;

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// What an exception says, on one line.
std::string one_line(const std::exception& exception) {
  const auto* of_opencv = dynamic_cast<const cv::Exception*>(&exception);
  std::string text = of_opencv != nullptr ? std::string(of_opencv->err) : exception.what();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

bool is_in_image_library() { return library_is_at_work; }

LibraryAtWork::LibraryAtWork() : lock_(library_mutex()), kept_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (kept_ >= 0 && nothing >= 0) ::dup2(nothing, STDERR_FILENO);
  if (nothing >= 0) ::close(nothing);
  library_is_at_work = true;
}

LibraryAtWork::~LibraryAtWork() {
  library_is_at_work = false;
  if (kept_ < 0) return;
  ::dup2(kept_, STDERR_FILENO);
  ::close(kept_);
}

Error no_image_memory(std::string_view what) {
  return {ErrorKind::kMemory, fmt::format("no memory is left to {} it; give the run more, or give {}", what,
                                          option_name("max-image-size"))};
}

Error decoding_error(const std::exception& exception) {
  const auto* of_opencv = dynamic_cast<const cv::Exception*>(&exception);
  if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr ||
      (of_opencv != nullptr && of_opencv->code == cv::Error::StsNoMem))
    return no_image_memory("decode");
  return {ErrorKind::kInput, "does not decode: " + one_line(exception)};
}

}  // namespace quorum
