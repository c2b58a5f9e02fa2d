#include "engine/io/image_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "engine/core/option.h"
#include "engine/io/file.h"
#include "engine/io/heif_file.h"
#include "engine/io/unread_image.h"
#include "engine/io/view_names.h"

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

Error no_memory(std::string_view what) {
  return {ErrorKind::kMemory, fmt::format("no memory is left to {} it; give the run more, or give {}", what,
                                          option_name("max-image-size"))};
}

Error decoding_error(const std::exception& exception) {
  const auto* of_opencv = dynamic_cast<const cv::Exception*>(&exception);
  if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr ||
      (of_opencv != nullptr && of_opencv->code == cv::Error::StsNoMem))
    return no_memory("decode");
  return {ErrorKind::kInput, "does not decode: " + one_line(exception)};
}

/// Whether so much memory is to be had now.
bool has_memory(std::size_t bytes) {
  const std::unique_ptr<char, decltype(&std::free)> probe(static_cast<char*>(std::malloc(bytes)), &std::free);
  return probe != nullptr;
}

std::atomic<bool> library_is_at_work = false;

/// While it lives, what libraries print on standard error is dropped: libpng tells of damage there, and we do so in our
/// own line. One at a time.
class LibraryAtWork {
 public:
  LibraryAtWork() : lock_(mutex()), kept_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (kept_ >= 0 && nothing >= 0) ::dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) ::close(nothing);
    library_is_at_work = true;
  }
  ~LibraryAtWork() {
    library_is_at_work = false;
    if (kept_ < 0) return;
    ::dup2(kept_, STDERR_FILENO);
    ::close(kept_);
  }
  LibraryAtWork(const LibraryAtWork&) = delete;
  LibraryAtWork& operator=(const LibraryAtWork&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_;
  int kept_;
};

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

/// Decodes the stored pixels with the flags of cv::imdecode. path: for messages.
Expected<cv::Mat> decode_bytes(const std::filesystem::path& path, std::string bytes, int flags) {
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
    if (!has_memory(kDecoder + 8 * bytes.size())) return std::unexpected(no_memory("decode").within(path.string()));
    return image_failure(path, "is damaged or of an unknown kind of image; replace the file");
  } catch (const std::exception& exception) {
    return std::unexpected(decoding_error(exception).within(path.string()));
  }
}

Expected<cv::Mat> decode(const std::filesystem::path& path, int flags) {
  QUORUM_ASSIGN(auto bytes, read_file(path));
  return decode_bytes(path, std::move(bytes), flags);
}

cv::Mat disc(int radius) {
  cv::Mat element = cv::Mat::zeros(2 * radius + 1, 2 * radius + 1, CV_8UC1);
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      if (x * x + y * y <= radius * radius) element.at<std::uint8_t>(y + radius, x + radius) = 1;
  return element;
}

}  // namespace

namespace {

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
  QUORUM_ASSIGN(auto decoded, decode_bytes(path, std::move(bytes), cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH));
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

bool is_in_image_library() { return library_is_at_work; }

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
    if (!cv::imencode(ending, blue_first, encoded, parameters)) return std::unexpected(no_memory("encode"));
  } catch (const std::exception&) {
    return std::unexpected(no_memory("encode"));
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
