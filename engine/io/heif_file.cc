#include "engine/io/heif_file.h"

#include <libheif/heif.h>

#include <algorithm>
#include <array>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <string>

namespace quorum {
namespace {

std::unexpected<Error> refuse(const heif_error& error) {
  if (error.code == heif_error_Memory_allocation_error)
    return failure(ErrorKind::kMemory, "no memory is left to decode it; give the run more");
  return failure(ErrorKind::kInput, std::string("does not decode: ") + error.message);
}

template <typename T>
using Owned = std::unique_ptr<T, void (*)(const T*)>;

/// The main picture of a file; bytes must outlive it.
class HeifPicture {
 public:
  Expected<void> open(std::string_view bytes) {
    if (context_ == nullptr) return failure(ErrorKind::kMemory, "no memory is left to decode it; give the run more");
    heif_error error = heif_context_read_from_memory_without_copy(context_.get(), bytes.data(), bytes.size(), nullptr);
    if (error.code != heif_error_Ok) return refuse(error);
    heif_image_handle* handle = nullptr;
    error = heif_context_get_primary_image_handle(context_.get(), &handle);
    handle_.reset(handle);
    if (error.code != heif_error_Ok) return refuse(error);
    return {};
  }
  [[nodiscard]] const heif_image_handle* handle() const { return handle_.get(); }

 private:
  std::unique_ptr<heif_context, void (*)(heif_context*)> context_{heif_context_alloc(), &heif_context_free};
  Owned<heif_image_handle> handle_{nullptr, &heif_image_handle_release};
};

}  // namespace

bool is_heif(std::string_view bytes) {
  constexpr std::array<std::string_view, 10> kBrands = {"heic", "heix", "hevc", "hevx", "heim",
                                                        "heis", "mif1", "msf1", "avif", "avis"};
  return bytes.size() >= 12 && bytes.substr(4, 4) == "ftyp" && std::ranges::count(kBrands, bytes.substr(8, 4)) > 0;
}

Expected<ImageHeader> read_heif_header(std::string_view bytes) {
  HeifPicture picture;
  if (auto opened = picture.open(bytes); !opened) return std::unexpected(opened.error());
  ImageHeader header;
  header.size = {heif_image_handle_get_width(picture.handle()), heif_image_handle_get_height(picture.handle())};
  header.has_alpha = heif_image_handle_has_alpha_channel(picture.handle()) != 0;
  return header;
}

Expected<cv::Mat> decode_heif(std::string_view bytes) {
  HeifPicture picture;
  if (auto opened = picture.open(bytes); !opened) return std::unexpected(opened.error());
  const bool has_alpha = heif_image_handle_has_alpha_channel(picture.handle()) != 0;
  heif_image* decoded = nullptr;
  const heif_error error =
      heif_decode_image(picture.handle(), &decoded, heif_colorspace_RGB,
                        has_alpha ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB, nullptr);
  const Owned<heif_image> image(decoded, &heif_image_release);
  if (error.code != heif_error_Ok) return refuse(error);
  int stride = 0;
  std::uint8_t* pixels = heif_image_get_plane(decoded, heif_channel_interleaved, &stride);
  const int width = heif_image_get_width(decoded, heif_channel_interleaved);
  const int height = heif_image_get_height(decoded, heif_channel_interleaved);
  if (pixels == nullptr || width <= 0 || height <= 0)
    return failure(ErrorKind::kInput, "does not decode: it has no pixels");
  const cv::Mat rgb(height, width, has_alpha ? CV_8UC4 : CV_8UC3, pixels, static_cast<std::size_t>(stride));
  cv::Mat result;
  cv::cvtColor(rgb, result, has_alpha ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGB2BGR);
  return result;
}

}  // namespace quorum
