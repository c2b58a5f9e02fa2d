#include "engine/io/unread_image.h"

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/image_size.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

ColorImage gradient() {
  ColorImage image(64, 48);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = make_rgb(static_cast<std::uint32_t>(4 * x), static_cast<std::uint32_t>(5 * y), 90);
  return image;
}

TEST(UnreadImage, AJpegThatWasCutOffIsRefusedNotFilledWithGray) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jpg";
  const std::string whole = encode_jpeg(gradient(), 90).value();
  write_text(path, whole);
  EXPECT_TRUE(read_image(path));
  write_text(path, whole + std::string(100, '\0'));
  EXPECT_TRUE(read_image(path)) << "some cameras write more behind the picture";
  for (const std::size_t bytes : {whole.size() - 2, whole.size() * 3 / 4}) {
    write_text(path, whole.substr(0, bytes));
    expect_bad_input(read_image(path), {"a.jpg", "ends too early", "copy it again"});
  }
  write_text(path, whole.substr(0, whole.size() * 3 / 4) + std::string(whole.size() / 4, '\0'));
  expect_bad_input(read_image(path), {"a.jpg", "ends too early"});
}

TEST(UnreadImage, AThumbnailBeforeThePictureIsNotItsEnd) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.jpg";
  const std::string whole = encode_jpeg(gradient(), 90).value();
  const std::string thumbnail("\xff\xe1\0\6Ex\xff\xd9", 8);  // a segment that holds the marker of the end
  write_text(path, whole.substr(0, 2) + thumbnail + whole.substr(2));
  EXPECT_TRUE(read_image(path));
  write_text(path, whole.substr(0, 2) + thumbnail + whole.substr(2, whole.size() - 40));
  expect_bad_input(read_image(path), {"ends too early"});
}

TEST(UnreadImage, OtherKindsAreNamedWithTheWayToConvertThem) {
  const TemporaryFolder folder;
  const struct {
    const char* name;
    std::string bytes;
    const char* remedy;
  } files[] = {{"a.gif", "GIF89a" + std::string(40, '\1'), "convert it to PNG"},
               {"a.nef", std::string("MM\0*\0\0\0\10", 8) + std::string(40, '\1'), "develop"},
               {"a.CR3", std::string("\0\0\0\30ftypcrx ", 12) + std::string(40, '\1'), "develop"},
               {"a.psd", "8BPS" + std::string(40, '\1'), "save it as TIFF"},
               {"a.png", "version https://git-lfs.github.com/spec/v1\noid sha256:12\n", "git lfs pull"}};
  for (const auto& file : files) {
    write_text(folder.path() / file.name, file.bytes);
    expect_bad_input(read_image(folder.path() / file.name), {file.name, file.remedy});
    expect_bad_input(read_image_header(folder.path() / file.name), {file.name, file.remedy});
  }
  write_text(folder.path() / "b.dng", encode_png(gradient()).value());
  EXPECT_TRUE(read_image(folder.path() / "b.dng")) << "whatever its name, it is a PNG file";
}

}  // namespace
}  // namespace quorum
