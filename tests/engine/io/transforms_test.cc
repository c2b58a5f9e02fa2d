#include "engine/io/transforms.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/io/file.h"
#include "engine/io/image_store.h"
#include "engine/io/masks.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "engine/io/write_image.h"
#include "tests/engine/io/io_test.h"
#include "tests/support/scene_formats.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// Four frames, a.png to d.png in images, with focal lengths 70 and 72.
class TransformsTest : public testing::Test {
 protected:
  TransformsTest() { write_scene_formats(folder_.path(), make_colmap_model("PINHOLE")); }
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / "transforms" / name; }
  Expected<Scene> read(const fs::path& images = {}) { return read_transforms(path(""), images); }
  /// Adds fields to the file, or to its first frame.
  void add(const std::string& fields) { replace("\"frames\"", fields + ", \"frames\""); }
  void add_to_frame(const std::string& fields) { replace("{\"file_path\"", "{" + fields + ", \"file_path\""); }
  void replace(const std::string& from, const std::string& to) {
    std::string text = read_file(path("transforms.json")).value();
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(path("transforms.json"), text.replace(at, from.size(), to));
  }
  void reset() { fs::copy_file(path("kept.json"), path("transforms.json"), fs::copy_options::overwrite_existing); }
  void SetUp() override { fs::copy_file(path("transforms.json"), path("kept.json")); }

  TemporaryFolder folder_;
};

using Transforms = TransformsTest;

TEST_F(Transforms, FisheyesAreKnownByFlagAndByName) {
  for (const char* field : {"\"is_fisheye\": true", "\"camera_model\": \"OPENCV_FISHEYE\"", "\"is_fisheye\": 1"}) {
    reset();
    add(field + std::string(", \"k1\": 0.02, \"k3\": 0.001"));
    const auto scene = read();
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_TRUE(scene->views[0].lens) << field;
    EXPECT_EQ(scene->views[0].lens->model, Lens::Model::kFisheye);
    EXPECT_EQ(scene->views[0].lens->coefficients[2], 0.001);
  }
  add("\"p1\": 0.001");
  EXPECT_EQ(read()->views[0].lens->model, Lens::Model::kThinPrismFisheye);
  reset();
  add_to_frame("\"is_fisheye\": true");
  EXPECT_TRUE(read()->views[0].lens) << "of one frame";
  EXPECT_FALSE(read()->views[1].lens);
  reset();
  add("\"is_fisheye\": false");
  EXPECT_FALSE(read()->views[0].lens);
}

TEST_F(Transforms, RadialTermsAreThoseOfTheFormatsProgram) {
  add("\"k1\": 0.1, \"k4\": 0.02");
  // nerfstudio: 1 + k1 r^2 + k2 r^4 + k3 r^6 + k4 r^8.
  const double r2 = 0.25;
  Lens lens = read()->views[0].lens.value();
  EXPECT_NEAR(lens.project({0.5, 0}).x(), lens.principal.x() + 70 * 0.5 * (1 + 0.1 * r2 + 0.02 * std::pow(r2, 4)),
              1e-9);
  add("\"k6\": 0.03");
  lens = read()->views[0].lens.value();
  EXPECT_NEAR(lens.project({0.5, 0}).x(),
              lens.principal.x() + 70 * 0.5 * (1 + 0.1 * r2) / (1 + 0.02 * r2 + 0.03 * std::pow(r2, 3)), 1e-9);
}

TEST_F(Transforms, WhatChangesTheGeometryAndIsNotUnderstoodIsRefused) {
  for (const char* model : {"EQUIRECTANGULAR", "FISHEYE624", "ORTHOPHOTO", "opencv"}) {
    reset();
    add(fmt::format("\"camera_model\": \"{}\"", model));
    expect_bad_input(read(), {"transforms.json: frame \"images/a.png\"", model});
    reset();
    add_to_frame(fmt::format("\"camera_model\": \"{}\"", model));
    expect_bad_input(read(), {model});
  }
  for (const char* field : {"\"ftheta_p0\": 0.1", "\"equirectangular\": true", "\"rolling_shutter\": [0, 0, 0.5, 0]",
                            "\"distortion_params\": [0.1]", "\"s1\": 0.01"}) {
    reset();
    add(field);
    expect_bad_input(read(), {std::string_view(field).substr(1, 2), "not understood"});
  }
  for (const char* field : {"\"rolling_shutter\": [0, 0, 0, 0]", "\"latlong\": false", "\"skew\": 0.0"}) {
    reset();
    add(field);
    EXPECT_TRUE(read()) << field;
  }
  for (const char* field : {"\"k1\": \"0.1\"", "\"camera_model\": 3", "\"cy\": []"}) {
    reset();
    add_to_frame(field);
    expect_bad_input(read(), {"frame \"images/a.png\"", std::string_view(field).substr(1, 2)});
  }
}

TEST_F(Transforms, FieldsThatAreNotUsedAreNamedOnce) {
  add("\"aabb_scale\": 16, \"strange\\u001b\": 1");
  add_to_frame("\"depth_file_path\": \"d.png\", \"sharpness\": 5");
  const Scene scene = read_scene(path(""), {}).value();
  EXPECT_EQ(scene.notes, (std::vector<std::string>{"transforms.json: not used: depth_file_path, strange?"}));
}

TEST_F(Transforms, AScaleOfTheCameraMeansNothing) {
  const Scene plain = read().value();
  std::string text = read_file(path("transforms.json")).value();
  // Scales the axes of all frames: the first three numbers of each row.
  std::string scaled;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t row = text.find("[", at);
    const bool is_row =
        row != std::string::npos && row + 1 < text.size() && (text[row + 1] == '-' || std::isdigit(text[row + 1]));
    const std::size_t end = row == std::string::npos ? text.size() : row + 1;
    scaled += text.substr(at, end - at);
    at = end;
    if (!is_row) continue;
    for (const double scale : {0.01, 0.02, 0.01}) {
      const std::size_t comma = text.find(',', at);
      scaled += fmt::format("{:.17g}, ", scale * std::stod(text.substr(at, comma - at)));
      at = comma + 1;
    }
  }
  write_text(path("transforms.json"), scaled);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  for (std::size_t i = 0; i < plain.views.size(); ++i) {
    const Camera& a = plain.views[i].camera;
    const Camera& b = scene->views[i].camera;
    EXPECT_LT((a.camera_from_world - b.camera_from_world).norm(), 1e-14);
    EXPECT_LT((a.translation - b.translation).norm(), 1e-13);
  }
  ASSERT_EQ(scene->notes.size(), 1U);
  EXPECT_TRUE(scene->notes[0].contains("scale in the transform_matrix of 4 frames")) << scene->notes[0];
}

TEST_F(Transforms, MasksOfFramesAreTaken) {
  fs::create_directories(path("masks"));
  ColorImage half(128, 96, make_rgb(0, 0, 0));  // twice the photograph's size
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < 64; ++x) half.at(x, y) = make_rgb(255, 255, 255);
  write_png(path("masks/a.png"), half).value();
  add_to_frame("\"mask_path\": \"masks/a.png\"");
  Scene scene = read().value();
  EXPECT_EQ(scene.views[0].mask_path, path("masks/a.png"));
  EXPECT_TRUE(scene.views[1].mask_path.empty());
  EXPECT_EQ(scene.notes, (std::vector<std::string>{"1 frames have a mask (mask_path)"}));
  ImageStore images(scene, 0);
  const auto mask = images.mask(0);
  ASSERT_TRUE(mask) << mask.error().message;
  EXPECT_EQ((*mask)->at(31, 20), 1);
  EXPECT_EQ((*mask)->at(32, 20), 0);
  replace("masks/a.png", "masks/none.png");
  expect_bad_input(read(), {"frame 0", "mask_path \"masks/none.png\" is not there"});
}

TEST_F(Transforms, AFolderOfMasksNeedsNotRepeatTheFoldersOfThePhotographs) {
  fs::create_directories(path("masks"));
  for (const char* name : {"a.png", "b.png.png", "c.png", "d.png"})
    write_png(path("masks") / name, ColorImage(64, 48, make_rgb(255, 255, 255))).value();
  std::vector<View> views = read()->views;
  const auto found = find_masks(path("masks"), views);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(views[0].mask_path, path("masks/a.png"));
  EXPECT_EQ(views[1].mask_path, path("masks/b.png.png"));
  views[1].image_name = "other/a.png";
  expect_bad_input(find_masks(path("masks"), views), {"a.png would be the mask of both images/a.png and other/a.png"});
}

TEST_F(Transforms, PointsOfACloudAreSeenByTheViewsBeforeThem) {
  Mesh cloud;
  cloud.vertices.resize(3);
  cloud.vertices[1].position = {0.1F, 0, 0};
  cloud.vertices[2].position = {0, 0, -100};  // behind all cameras
  ASSERT_TRUE(write_ply(path("sparse_pc.ply"), cloud));
  add("\"ply_file_path\": \"sparse_pc.ply\"");
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->points.size(), 2U);
  EXPECT_EQ(scene->points[0].views, (std::vector<int>{0, 1, 2, 3}));
  fs::remove(path("sparse_pc.ply"));
  EXPECT_TRUE(read()->points.empty());
  EXPECT_TRUE(read()->notes.at(0).contains("sparse_pc.ply"));
}

TEST_F(Transforms, PhotographsMayStandElsewhereOrBeAbsent) {
  fs::rename(path("images"), path("images_2"));
  const auto elsewhere = read(path("images_2"));
  ASSERT_TRUE(elsewhere) << elsewhere.error().message;
  EXPECT_EQ(elsewhere->views[0].image_path, path("images_2/a.png"));
  EXPECT_EQ(elsewhere->views[0].name, "images_a");
  fs::rename(path("images_2"), path("images"));
  fs::remove(path("images/b.png"));
  EXPECT_EQ(read()->notes, (std::vector<std::string>{"1 of 4 photographs is not there and left out: images/b.png"}));
  replace("./images/c.png", "./images/c");
  EXPECT_EQ(read()->views[1].image_name, "images/c.png") << "without its extension";
  replace("./images/c", "images\\\\c.png");
  EXPECT_EQ(read()->views.size(), 3U);
}

TEST_F(Transforms, AFlagOfAnotherKindIsRefused) {
  for (const char* value : {"\"false\"", "[true]"}) {
    reset();
    add("\"is_fisheye\": " + std::string(value));
    expect_bad_input(read(), {"frame \"images/a.png\"", "is_fisheye is neither true nor false"});
  }
}

TEST_F(Transforms, UnknownFieldsThatSpeakOfTheLensAreRefusedByName) {
  for (const char* field :
       {"isFisheye", "distortion_model", "lens_is_equirectangular", "parallax_shift", "from_mitsuba"}) {
    reset();
    add("\"" + std::string(field) + "\": true");
    expect_bad_input(read(), {"its field", field, "remove it"});
  }
  for (const char* field : {"\"undistorted\": true", "\"isFisheye\": false", "\"fisheye_crop_radius\": 20"}) {
    reset();
    add(field);
    EXPECT_TRUE(read()) << field;
  }
}

TEST_F(Transforms, AMatrixThatIsNoPoseIsRefusedWithTheRemedy) {
  replace("[0, 0, 0, 1]", "[0, 0, 0, 2]");
  expect_bad_input(read(), {"frame 0", "last row", "divide"});
  reset();
  replace("[0, 0, 0, 1]", "[0, 0, 0, 1], [0, 0, 0, 1]");
  expect_bad_input(read(), {"frame 0", "no 4 x 4 matrix"});
}

TEST_F(Transforms, AMirroredMatrixIsToldAsLeftHanded) {
  const std::string text = read_file(path("transforms.json")).value();
  const std::size_t begin = text.find("[[");
  const std::size_t end = text.find("]]", begin) + 2;
  replace(text.substr(begin, end - begin), "[[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]");
  expect_bad_input(read(), {"frame 0", "mirrors", "left-handed", "turn an axis"});
}

TEST_F(Transforms, AMaskPathOfAnotherKindOrPlaceIsTold) {
  add_to_frame("\"mask_path\": 3");
  expect_bad_input(read(), {"frame 0", "mask_path is no text"});
  reset();
  add("\"mask_path\": \"masks/a.png\"");
  EXPECT_EQ(read()->notes.at(0), "transforms.json: not used: mask_path");
}

TEST_F(Transforms, BrokenSyntaxIsToldWithItsLine) {
  replace("\"fl_x\": 70", "\"fl_x\": NaN");
  expect_bad_input(read(), {"transforms.json:", "is no JSON object", "no NaN"});
  write_text(path("transforms.json"), "{\n\"frames\": [\n],\n}\n");
  expect_bad_input(read(), {"transforms.json:4: is no JSON object"});
  write_text(path("transforms.json"), "{\"fl_x\": 1e999}");
  expect_bad_input(read(), {"transforms.json: is no JSON object", "too large"});
}

}  // namespace
}  // namespace quorum
