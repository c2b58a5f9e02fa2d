#include "engine/io/write_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/io/file.h"
#include "engine/io/image_library.h"
#include "engine/io/view_names.h"

namespace quorum {
namespace {

/// ending: of a format that takes all images.
Expected<std::string> encode(const ColorImage& image, const std::string& ending, const std::vector<int>& parameters) {
  if (image.empty())
    return failure(ErrorKind::kInput,
                   fmt::format("an image without pixels can't be written as {}", ending == ".png" ? "PNG" : ending));
  std::vector<std::uint8_t> encoded;
  try {
    // OpenCV knows no constant matrix over foreign memory; it only reads here.
    const cv::Mat pixels(image.height, image.width, CV_8UC4, const_cast<Rgba*>(image.values.data()));
    cv::Mat blue_first;
    cv::cvtColor(pixels, blue_first, cv::COLOR_RGBA2BGR);
    // What fails, with an exception or without, is memory.
    const LibraryAtWork library;
    if (!cv::imencode(ending, blue_first, encoded, parameters)) return std::unexpected(no_image_memory("encode"));
  } catch (const std::exception&) {
    return std::unexpected(no_image_memory("encode"));
  }
  return std::string(reinterpret_cast<const char*>(encoded.data()), encoded.size());
}

}  // namespace

Expected<std::string> encode_png(const ColorImage& image) {
  return encode(image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 3});
}

Expected<std::string> encode_jpeg(const ColorImage& image, int quality) {
  return encode(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

Expected<void> write_image(const std::filesystem::path& path, const ColorImage& image) {
  const std::string ending = folded(path.extension().string());
  constexpr std::array kEndings = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".webp"};
  if (std::ranges::count(kEndings, ending) == 0)
    return failure(ErrorKind::kUsage,
                   fmt::format("{}: a picture ends in .png, .jpg, .tif, .bmp or .webp", path.string()));
  const auto bytes = ending == ".png" ? encode_png(image) : encode(image, ending, {});
  if (!bytes) return std::unexpected(bytes.error().within(path.string()));
  return write_file(path, *bytes);
}

Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image) {
  const auto bytes = encode_png(image);
  if (!bytes) return std::unexpected(bytes.error().within(path.string()));
  return write_file(path, *bytes);
}

}  // namespace quorum
