#include "engine/io/image_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <climits>
#include <exception>
#include <mutex>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "engine/io/file.h"

namespace quorum {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the bytes of an Rgba are taken for R, G, B, A in this order");

std::unexpected<Error> image_failure(const std::filesystem::path& path, std::string_view message) {
  return failure(ErrorKind::kInput, fmt::format("{}: {}", path.string(), message));
}

/// What an exception says, on one line.
std::string one_line(const std::exception& exception) {
  const auto* of_opencv = dynamic_cast<const cv::Exception*>(&exception);
  std::string text = of_opencv != nullptr ? std::string(of_opencv->err) : exception.what();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// While it lives, what libraries print on standard error is dropped: libpng tells of damage there, and we do so in our
/// own line. One at a time.
class SilentStandardError {
 public:
  SilentStandardError() : lock_(mutex()), kept_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nothing >= 0) ::dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) ::close(nothing);
  }
  ~SilentStandardError() {
    if (kept_ < 0) return;
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }
  SilentStandardError(const SilentStandardError&) = delete;
  SilentStandardError& operator=(const SilentStandardError&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_;
  int kept_;
};

/// Decodes the stored pixels with the flags of cv::imdecode.
Expected<cv::Mat> decode(const std::filesystem::path& path, int flags) {
  auto bytes = read_file(path);
  if (!bytes) return std::unexpected(bytes.error());
  if (bytes->empty() || bytes->size() > INT_MAX)
    return image_failure(path, fmt::format("{} bytes are not an image; replace the file", bytes->size()));
  try {
    const cv::Mat encoded(1, static_cast<int>(bytes->size()), CV_8UC1, bytes->data());
    cv::Mat image;
    {
      const SilentStandardError silent;
      image = cv::imdecode(encoded, flags | cv::IMREAD_IGNORE_ORIENTATION);
    }
    if (image.empty()) return image_failure(path, "is damaged or of an unknown kind of image; replace the file");
    return image;
  } catch (const std::exception& exception) {
    return image_failure(path, "does not decode: " + one_line(exception));
  }
}

cv::Mat disc(int radius) {
  cv::Mat element = cv::Mat::zeros(2 * radius + 1, 2 * radius + 1, CV_8UC1);
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      if (x * x + y * y <= radius * radius) element.at<std::uint8_t>(y + radius, x + radius) = 1;
  return element;
}

}  // namespace

Expected<ColorImage> read_image(const std::filesystem::path& path) {
  const auto decoded = decode(path, cv::IMREAD_COLOR);
  if (!decoded) return std::unexpected(decoded.error());
  try {
    ColorImage image(decoded->cols, decoded->rows);
    cv::Mat pixels(image.height, image.width, CV_8UC4, image.values.data());
    cv::cvtColor(*decoded, pixels, cv::COLOR_BGR2RGBA);
    return image;
  } catch (const std::exception& exception) {
    return image_failure(path, "does not decode: " + one_line(exception));
  }
}

Expected<Mask> read_mask(const std::filesystem::path& path) {
  // At full depth, so that the darkest values above 0 of a 16-bit mask are not rounded to 0.
  const auto decoded = decode(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH);
  if (!decoded) return std::unexpected(decoded.error());
  try {
    Mask mask(decoded->cols, decoded->rows);
    cv::Mat pixels(mask.height, mask.width, CV_8UC1, mask.values.data());
    cv::compare(*decoded, cv::Scalar(0), pixels, cv::CMP_GT);
    for (std::uint8_t& value : mask.values) value &= 1U;
    return mask;
  } catch (const std::exception& exception) {
    return image_failure(path, "does not decode: " + one_line(exception));
  }
}

Expected<void> write_png(const std::filesystem::path& path, const ColorImage& image) {
  if (image.empty()) return image_failure(path, "an image without pixels can't be written as PNG");
  constexpr int kCompression = 3;
  std::vector<std::uint8_t> encoded;
  try {
    // OpenCV knows no constant matrix over foreign memory; it only reads here.
    const cv::Mat pixels(image.height, image.width, CV_8UC4, const_cast<Rgba*>(image.values.data()));
    cv::Mat blue_first;
    cv::cvtColor(pixels, blue_first, cv::COLOR_RGBA2BGR);
    if (!cv::imencode(".png", blue_first, encoded, {cv::IMWRITE_PNG_COMPRESSION, kCompression}))
      return image_failure(path, fmt::format("{} x {} pixels can't be encoded as PNG", image.width, image.height));
  } catch (const std::exception& exception) {
    return image_failure(path, "can't be encoded as PNG: " + one_line(exception));
  }
  return write_file(path, {reinterpret_cast<const char*>(encoded.data()), encoded.size()});
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
