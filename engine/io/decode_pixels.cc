#include "engine/io/decode_pixels.h"

#include <fmt/format.h>

#include <climits>
#include <cstdlib>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "engine/io/heif_file.h"
#include "engine/io/image_library.h"
#include "engine/io/unread_image.h"

namespace quorum {
namespace {

std::unexpected<Error> image_failure(const std::filesystem::path& path, std::string_view message) {
  return failure(ErrorKind::kInput, fmt::format("{}: {}", path.string(), message));
}

/// Whether so much memory is to be had now.
bool has_memory(std::size_t bytes) {
  const std::unique_ptr<char, decltype(&std::free)> probe(static_cast<char*>(std::malloc(bytes)), &std::free);
  return probe != nullptr;
}

/// HEIC and AVIF, with as many channels as cv::imdecode would give.
Expected<cv::Mat> decode_heif_as(const std::filesystem::path& path, std::string_view bytes, int flags) {
  try {
    auto image = [bytes] {
      const LibraryAtWork library;
      return decode_heif(bytes);
    }();
    if (!image) return std::unexpected(image.error().within(path.string()));
    if (flags == cv::IMREAD_UNCHANGED) return image;
    const bool is_color = (flags & cv::IMREAD_COLOR) != 0;
    if (!is_color) cv::cvtColor(*image, *image, image->channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
    if (is_color && image->channels() == 4) cv::cvtColor(*image, *image, cv::COLOR_BGRA2BGR);
    return image;
  } catch (const std::exception& exception) {
    return std::unexpected(decoding_error(exception).within(path.string()));
  }
}

/// TIFF files of floating-point values decode with the channels that they have alone. Empty if it is none.
cv::Mat decode_float_tiff(const cv::Mat& encoded, int flags) {
  cv::Mat image;
  {
    const LibraryAtWork library;
    image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  }
  if (image.empty() || image.depth() < CV_32F) return {};
  if (flags == cv::IMREAD_UNCHANGED) return image;
  image.convertTo(image, CV_32F);
  const bool is_color = (flags & cv::IMREAD_COLOR) != 0;
  if (is_color && image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  if (is_color && image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
  if (!is_color && image.channels() > 1) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
  return image;
}

}  // namespace

Expected<cv::Mat> decode_pixels(const std::filesystem::path& path, std::string bytes, int flags) {
  if (bytes.empty() || bytes.size() > INT_MAX)
    return image_failure(path, fmt::format("{} bytes are not an image; replace the file", bytes.size()));
  if (const std::string why = why_unread(path, bytes, true); !why.empty()) return image_failure(path, why);
  if (is_heif(bytes)) return decode_heif_as(path, bytes, flags);
  // Without the marker of the end OpenCV leaves the last rows out.
  constexpr std::string_view kJpegEnd = "\xff\xd9";
  if (bytes.starts_with("\xff\xd8") && !bytes.ends_with(kJpegEnd)) bytes += kJpegEnd;
  try {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
    cv::Mat image;
    // OpenCV tells of no memory as of damage; what fails twice while there is memory is damaged.
    for (int attempt = 0; attempt < 2 && image.empty(); ++attempt) {
      const LibraryAtWork library;
      image = cv::imdecode(encoded, flags | cv::IMREAD_IGNORE_ORIENTATION);
    }
    if (image.empty()) image = decode_float_tiff(encoded, flags);
    if (!image.empty()) return image;
    constexpr std::size_t kDecoder = std::size_t{32} << 20;  // more than one takes beside the pixels of a small image
    if (!has_memory(kDecoder + 8 * bytes.size()))
      return std::unexpected(no_image_memory("decode").within(path.string()));
    return image_failure(path, "is damaged or of an unknown kind of image; replace the file");
  } catch (const std::exception& exception) {
    return std::unexpected(decoding_error(exception).within(path.string()));
  }
}

}  // namespace quorum
