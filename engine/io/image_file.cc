#include "engine/io/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "engine/io/decode_pixels.h"
#include "engine/io/file.h"
#include "engine/io/image_library.h"

namespace quorum {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the bytes of an Rgba are taken for R, G, B, A in this order");

Expected<cv::Mat> decode(const std::filesystem::path& path, int flags) {
  QUORUM_ASSIGN(auto bytes, read_file(path));
  return decode_pixels(path, std::move(bytes), flags);
}

cv::Mat disc(int radius) {
  cv::Mat element = cv::Mat::zeros(2 * radius + 1, 2 * radius + 1, CV_8UC1);
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      if (x * x + y * y <= radius * radius) element.at<std::uint8_t>(y + radius, x + radius) = 1;
  return element;
}

/// How the values of a file become 8 bits: (value - low) * 255 / (high - low), or a shift of bits where low is 0.
struct PixelRange {
  double low = 0.0;
  double high = 0.0;
  int bits = 0;          ///< of 16-bit values, 8 to 16
  bool stretch = false;  ///< low and high count, since a shift would leave few levels
};

/// The range of an image of 16-bit or floating-point values.
PixelRange range_of(const cv::Mat& image) {
  constexpr double kLeastLevels = 64;
  PixelRange range;
  cv::minMaxLoc(image.reshape(1), &range.low, &range.high);
  range.stretch = image.depth() != CV_16U;
  if (range.stretch) return range;
  for (range.bits = 8; range.bits < 16 && range.high >= std::exp2(range.bits);) range.bits += 2;
  const double levels = (range.high - range.low) / std::exp2(range.bits - 8);
  range.stretch = levels < kLeastLevels && range.high - range.low > levels + 1;
  return range;
}

/// The 8-bit image of one of more bits. Values of 16 bits keep their upper 8 bits, as libpng's own reduction does.
cv::Mat to_eight_bits(cv::Mat image) {
  if (image.depth() != CV_16U) {
    image.convertTo(image, CV_32F);
    cv::patchNaNs(image, 0.0);
  }
  const PixelRange range = range_of(image);
  cv::Mat result;
  if (range.stretch) {
    const double scale = range.high > range.low ? 255.0 / (range.high - range.low) : 0.0;
    image.convertTo(result, CV_8U, scale, -range.low * scale);
    return result;
  }
  result.create(image.rows, image.cols, CV_8UC(image.channels()));
  const int shift = range.bits - 8;
  for (int y = 0; y < image.rows; ++y) {
    const auto* from = image.ptr<std::uint16_t>(y);
    std::transform(from, from + static_cast<std::ptrdiff_t>(image.cols) * image.channels(), result.ptr<std::uint8_t>(y),
                   [shift](std::uint16_t value) { return static_cast<std::uint8_t>(value >> shift); });
  }
  return result;
}

Expected<ColorImage> to_color_image(const std::filesystem::path& path, cv::Mat decoded) {
  try {
    if (decoded.depth() != CV_8U) decoded = to_eight_bits(decoded);
    ColorImage image(decoded.cols, decoded.rows);
    cv::Mat pixels(image.height, image.width, CV_8UC4, image.values.data());
    cv::cvtColor(decoded, pixels, cv::COLOR_BGR2RGBA);
    return image;
  } catch (const std::exception& exception) {
    return std::unexpected(decoding_error(exception).within(path.string()));
  }
}

}  // namespace

Expected<ColorImage> read_image(const std::filesystem::path& path) {
  QUORUM_ASSIGN(auto decoded, decode(path, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH));
  return to_color_image(path, std::move(decoded));
}

Expected<ColorImage> decode_image(const std::filesystem::path& path, std::string bytes) {
  QUORUM_ASSIGN(auto decoded, decode_pixels(path, std::move(bytes), cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH));
  return to_color_image(path, std::move(decoded));
}

Expected<std::string> describe_pixel_range(const std::filesystem::path& path) {
  QUORUM_ASSIGN(auto decoded, decode(path, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH));
  if (decoded.depth() == CV_8U) return std::string();
  if (decoded.depth() != CV_16U) decoded.convertTo(decoded, CV_32F);
  const PixelRange range = range_of(decoded);
  if (!range.stretch && range.bits == 16) return std::string();
  const std::string values =
      fmt::format("{} holds values from {:.6g} to {:.6g}", path.filename().string(), range.low, range.high);
  if (range.stretch) return values + ": each photograph is taken by the range of its values";
  return fmt::format("{}: photographs are taken by their own range, this one as of {} bits", values, range.bits);
}

Expected<Mask> read_alpha(const std::filesystem::path& path) {
  QUORUM_ASSIGN(const auto decoded, decode(path, cv::IMREAD_UNCHANGED));
  try {
    Mask mask(decoded.cols, decoded.rows, 1);
    if (decoded.channels() != 4) return mask;
    cv::Mat alpha;
    cv::extractChannel(decoded, alpha, 3);
    const double half = decoded.depth() == CV_8U ? 127.5 : decoded.depth() == CV_16U ? 32767.5 : 0.5;
    cv::Mat pixels(mask.height, mask.width, CV_8UC1, mask.values.data());
    cv::compare(alpha, cv::Scalar(half), pixels, cv::CMP_GT);
    for (std::uint8_t& value : mask.values) value &= 1U;
    return mask;
  } catch (const std::exception& exception) {
    return std::unexpected(decoding_error(exception).within(path.string()));
  }
}

Mask scale_mask(const Mask& mask, int width, int height) {
  Mask scaled(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      scaled.at(x, y) = mask.at(static_cast<int>((2LL * x + 1) * mask.width / (2LL * width)),
                                static_cast<int>((2LL * y + 1) * mask.height / (2LL * height)));
  return scaled;
}

Expected<Mask> read_mask(const std::filesystem::path& path) {
  // At full depth, so that the darkest values above 0 of a 16-bit mask are not rounded to 0.
  QUORUM_ASSIGN(const auto decoded, decode(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH));
  try {
    Mask mask(decoded.cols, decoded.rows);
    cv::Mat pixels(mask.height, mask.width, CV_8UC1, mask.values.data());
    cv::compare(decoded, cv::Scalar(0), pixels, cv::CMP_GT);
    for (std::uint8_t& value : mask.values) value &= 1U;
    return mask;
  } catch (const std::exception& exception) {
    return std::unexpected(decoding_error(exception).within(path.string()));
  }
}

Mask mask_dark_background(const ColorImage& image, double level) {
  constexpr int kGrow = 10;
  constexpr int kShrink = 7;
  Mask mask(image.width, image.height);
  if (mask.empty()) return mask;
  std::ranges::transform(image.values, mask.values.begin(), [level](Rgba pixel) -> std::uint8_t {
    return std::max({red_of(pixel), green_of(pixel), blue_of(pixel)}) > level * 255.0 ? 1 : 0;
  });
  // OpenCV's default border is the one promised: below all values for dilate, above all values for erode.
  cv::Mat object(mask.height, mask.width, CV_8UC1, mask.values.data());
  cv::dilate(object, object, disc(kGrow));
  cv::erode(object, object, disc(kShrink));
  return mask;
}

}  // namespace quorum
