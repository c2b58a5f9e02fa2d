#include "engine/io/colmap_model.h"

#include <gtest/gtest.h>

#include "engine/io/colmap_files.h"
#include "tests/engine/io/colmap_test.h"
#include "tests/engine/io/io_test.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

using ColmapModelFiles = ColmapTest;

TEST_F(ColmapModelFiles, TextAndBinaryAreTheSame) {
  for (const char* kind : {"PINHOLE", "FULL_OPENCV"}) {
    const ColmapModel model = make_colmap_model(kind);
    write(model);
    const Scene binary = read().value();
    for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"}) fs::remove(path("sparse") / file);
    write_colmap_text(path("sparse"), model);
    const auto text = read();
    ASSERT_TRUE(text) << text.error().message;
    ASSERT_EQ(text->views.size(), binary.views.size());
    for (std::size_t i = 0; i < binary.views.size(); ++i) {
      EXPECT_EQ(text->views[i].camera.intrinsics, binary.views[i].camera.intrinsics);
      EXPECT_EQ(text->views[i].camera.camera_from_world, binary.views[i].camera.camera_from_world);
      EXPECT_EQ(text->views[i].camera.translation, binary.views[i].camera.translation);
      EXPECT_EQ(text->views[i].width, binary.views[i].width);
    }
    ASSERT_EQ(text->points.size(), binary.points.size());
    for (std::size_t i = 0; i < binary.points.size(); ++i) {
      EXPECT_EQ(text->points[i].position, binary.points[i].position);
      EXPECT_EQ(text->points[i].views, binary.points[i].views);
    }
  }
}

TEST_F(ColmapModelFiles, RigsAndFramesOfNewerModelsChangeNothing) {
  write(make_colmap_model("PINHOLE"));
  write_text(path("sparse/rigs.bin"), "rigs");
  write_text(path("sparse/frames.bin"), "frames");
  EXPECT_TRUE(read());
}

TEST_F(ColmapModelFiles, ModelWithoutPointsIsTaken) {
  write(make_colmap_model("PINHOLE"));
  fs::remove(path("sparse/points3D.bin"));
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->points.empty());
}

TEST_F(ColmapModelFiles, CutOffFilesAreRefusedWithoutLargeAllocations) {
  const ColmapModel model = make_colmap_model("OPENCV");
  write(model);
  for (const std::string file : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string bytes = read_file(path("sparse/" + file)).value();
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{7}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
      write_text(path("sparse/" + file), bytes.substr(0, size));
      expect_bad_input(read(), {file, "copy"});
    }
    write_text(path("sparse/" + file), bytes + "x");
    expect_bad_input(read(), {file, "1 bytes follow"});
    std::string counts = bytes;
    counts[6] = '\x7f';  // 2^54 records and more
    write_text(path("sparse/" + file), counts);
    expect_bad_input(read(), {file, "is shorter"});
    write_text(path("sparse/" + file), bytes);
  }
  // The count of an image's features, and of a point's track.
  change("sparse/images.bin", [](std::string& bytes) { bytes[8 + 4 + 56 + 4 + 6 + 5] = '\x7f'; });
  expect_bad_input(read(), {"images.bin", "image 1", "cut off"});
}

TEST_F(ColmapModelFiles, NamesOfSeveralLinesAreRefusedOnOne) {
  write(make_colmap_model("PINHOLE"));
  change("sparse/images.bin", [](std::string& bytes) { bytes[bytes.find("b.png")] = '\n'; });
  expect_bad_input(read(), {"images.bin", "image 2", "control characters"});
}

TEST_F(ColmapModelFiles, UnknownCameraModelIsNamed) {
  write(make_colmap_model("PINHOLE"));
  change("sparse/cameras.bin", [](std::string& bytes) { bytes[12] = 77; });
  expect_bad_input(read(), {"cameras.bin", "camera 1", "model 77"});
  expect_bad_input(parse_colmap_cameras_txt("cameras.txt", "# c\n1 FISHY 10 10 1 2 3\n"),
                   {"cameras.txt:2", "\"FISHY\"", "DIVISION"});
  expect_bad_input(parse_colmap_cameras_txt("c", "1 EQUIRECTANGULAR 10 10 10 10\n"), {"c:1", "panorama"});
  write(make_colmap_model("PINHOLE"));
  change("sparse/cameras.bin", [](std::string& bytes) { bytes[12] = 17; });
  expect_bad_input(read(), {"cameras.bin", "EQUIRECTANGULAR", "cut the panoramas"});
}

TEST_F(ColmapModelFiles, WrongLinesOfTextAreNamed) {
  expect_bad_input(parse_colmap_cameras_txt("c", "1 PINHOLE 10 10 1 2 3\n"), {"c:1", "a parameter is missing"});
  expect_bad_input(parse_colmap_cameras_txt("c", "1 PINHOLE 10 10 1 2 3 4 5\n"), {"c:1", "1 fields are left over"});
  expect_bad_input(parse_colmap_cameras_txt("c", "1 PINHOLE wide 10 1 2 3 4\n"), {"c:1", "WIDTH = \"wide\""});
  expect_bad_input(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 a.png\n1 2\n"), {"i:2", "POINT3D_ID is missing"});
  EXPECT_EQ(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 a.png")->size(), 1U) << "COLMAP reads it, too";
  expect_bad_input(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1\n\n"), {"i:1", "NAME is missing"});
  expect_bad_input(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 a\x1b[31m.png\n\n"), {"i:1", "control characters"});
  EXPECT_EQ(parse_colmap_cameras_txt("c",
                                     "\xef\xbb\xbf"
                                     "1 PINHOLE 10 10 1 2 3 4")
                ->size(),
            1U)
      << "a byte order mark";
  expect_bad_input(parse_colmap_points_txt("p", "1 0 0 0 1 2 300 0\n"), {"p:1", "a color = \"300\""});
  expect_bad_input(parse_colmap_points_txt("p", "1 0 0 0 1 2 3 0 7\n"), {"p:1", "POINT2D_IDX is missing"});
  EXPECT_EQ(parse_colmap_images_txt("i", "1 1 0 0 0 0 0 0 1 my photo.png\n\n2 1 0 0 0 0 0 0 1 b\n\n")->at(0).name,
            "my photo.png");
}

TEST_F(ColmapModelFiles, ReferencesToWhatIsAbsentAreNamed) {
  const ColmapModel good = make_colmap_model("PINHOLE");
  ColmapModel model = good;
  model.images[2].camera_id = 99;
  write(model);
  expect_bad_input(read(), {"images.bin", "image 30 refers to camera 99"});
  model = good;
  model.images[3].id = 99;
  write(model);
  change("sparse/images.bin", [&](std::string& bytes) {
    const std::size_t name = bytes.find("d.png");
    bytes[name - 4 - 56 - 4] = 98;
  });
  // Its sightings name an image that was removed.
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->notes.size(), 1U);
  EXPECT_TRUE(scene->notes[0].starts_with(std::to_string(good.images[3].observations.size()) + " sightings"))
      << scene->notes[0];
  model = good;
  model.cameras[1].id = 1;
  write(model);
  expect_bad_input(read(), {"cameras.bin", "camera 1 twice"});
  model = good;
  model.images[1].id = 10;
  write(model);
  expect_bad_input(read(), {"images.bin", "image 10 twice"});
  model = good;
  model.points[1].id = model.points[0].id;
  write(model);
  expect_bad_input(read(), {"points3D.bin", "point 1001 twice"});
}

}  // namespace
}  // namespace quorum
