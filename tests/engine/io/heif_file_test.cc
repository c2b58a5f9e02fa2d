// HEIC and AVIF among other photographs.
#include <gtest/gtest.h>
#include <libheif/heif.h>

#include <algorithm>
#include <memory>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/image_size.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

heif_error append(heif_context*, const void* data, std::size_t size, void* text) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(data), size);
  return {heif_error_Ok, heif_suberror_Unspecified, "ok"};
}

/// A picture of 64 x 48, red on its left half and blue on the other, as HEIC or AVIF; empty if libheif has no encoder.
std::string encode(heif_compression_format format) {
  const std::unique_ptr<heif_context, void (*)(heif_context*)> context(heif_context_alloc(), &heif_context_free);
  heif_encoder* encoder = nullptr;
  if (heif_context_get_encoder_for_format(context.get(), format, &encoder).code != heif_error_Ok) return {};
  heif_encoder_set_lossy_quality(encoder, 90);
  heif_image* image = nullptr;
  EXPECT_EQ(heif_image_create(64, 48, heif_colorspace_RGB, heif_chroma_interleaved_RGB, &image).code, heif_error_Ok);
  EXPECT_EQ(heif_image_add_plane(image, heif_channel_interleaved, 64, 48, 8).code, heif_error_Ok);
  int stride = 0;
  std::uint8_t* pixels = heif_image_get_plane(image, heif_channel_interleaved, &stride);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      std::uint8_t* pixel = pixels + y * stride + 3 * x;
      std::fill_n(pixel, 3, std::uint8_t{0});
      pixel[x < 32 ? 0 : 2] = 250;
    }
  EXPECT_EQ(heif_context_encode_image(context.get(), image, encoder, nullptr, nullptr).code, heif_error_Ok);
  std::string bytes;
  heif_writer writer{1, append};
  EXPECT_EQ(heif_context_write(context.get(), &writer, &bytes).code, heif_error_Ok);
  heif_image_release(image);
  heif_encoder_release(encoder);
  return bytes;
}

TEST(HeifFile, HeicAndAvifAreReadAsOtherPhotographs) {
  const TemporaryFolder folder;
  int encoders = 0;
  for (const auto& [format, name] : {std::pair{heif_compression_HEVC, "a.heic"}, {heif_compression_AV1, "a.avif"}}) {
    const std::string bytes = encode(format);
    if (bytes.empty()) continue;
    ++encoders;
    const auto path = folder.path() / name;
    write_text(path, bytes);
    EXPECT_EQ(read_image_size(path).value(), (ImageSize{64, 48})) << name;
    EXPECT_FALSE(read_image_header(path).value().has_alpha) << name;
    const auto image = read_image(path);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_GT(red_of(image->at(10, 20)), 200U) << name;
    EXPECT_LT(blue_of(image->at(10, 20)), 50U) << name;
    EXPECT_GT(blue_of(image->at(50, 20)), 200U) << name;
    EXPECT_EQ(read_alpha(path).value().at(3, 3), 1) << name;
    EXPECT_EQ(read_mask(path).value().at(3, 3), 1) << name;
    write_text(path, bytes.substr(0, bytes.size() / 2));
    expect_bad_input(read_image(path), {name, "does not decode"});
  }
  if (encoders == 0) GTEST_SKIP() << "libheif has no encoder here";
}

TEST(HeifFile, AFilmIsNoPhotograph) {
  const TemporaryFolder folder;
  write_text(folder.path() / "a.heic", std::string("\0\0\0\x20", 4) + "ftypisom" + std::string(40, '\1'));
  expect_bad_input(read_image_size(folder.path() / "a.heic"), {"a.heic", "replace the file"});
}

}  // namespace
}  // namespace quorum

// x265, which writes the picture, keeps a block to the end of the program. LeakSanitizer asks this function.
extern "C" [[gnu::visibility("default")]] const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libx265\n"; }
