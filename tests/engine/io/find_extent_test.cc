#include "engine/io/find_extent.h"

#include <gtest/gtest.h>

#include "engine/io/write_image.h"
#include "tests/engine/scene/camera_paths.h"
#include "tests/engine/scene/path_images.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// The scene with its photographs in a folder.
Scene with_photographs(Scene scene, const Surface& surface, const TemporaryFolder& folder) {
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    View& view = scene.views[i];
    view.name = std::to_string(i);
    view.image_path = folder.path() / (view.name + ".png");
    EXPECT_TRUE(write_png(view.image_path, image_of(view, surface)));
  }
  return scene;
}

TEST(FindExtent, OfAStripIsTheGroundBelow) {
  const TemporaryFolder folder;
  Scene scene = with_photographs(small_images(strip(4)), on_ground, folder);
  const auto found = find_extent(scene);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_GT(scene.bounds.low.z(), -1.5);
  EXPECT_LT(scene.bounds.high.z(), 1.5);
  EXPECT_LT(scene.bounds.low.x(), -2.0);
  EXPECT_GT(scene.bounds.high.x(), 5.0);
  EXPECT_TRUE(scene.points.empty());
  for (const View& view : scene.views) {
    EXPECT_GT(view.near_depth, 5.0);
    EXPECT_LT(view.near_depth, 8.0);
    EXPECT_GT(view.far_depth, 8.0);
    EXPECT_LT(view.far_depth, 12.0);
  }
}

TEST(FindExtent, OfPhotographsFromOnePlaceIsRefusedWithTheRemedy) {
  const TemporaryFolder folder;
  Scene scene = with_photographs(small_images(turn(4)), on_walls, folder);
  const auto found = find_extent(scene);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().kind, ErrorKind::kInput);
  EXPECT_NE(found.error().message.find("about one place"), std::string::npos);
  EXPECT_NE(found.error().message.find("bounds"), std::string::npos);
}

TEST(FindExtent, OfAnOrbitNeedsNoPhotographs) {
  Scene scene = orbit(8);
  EXPECT_TRUE(find_extent(scene));
  EXPECT_EQ(scene.views[0].far_depth, 0.0);
}

void put(View& view, const Eigen::Vector3d& center) {
  view.camera.translation = -view.camera.camera_from_world * center;
}

TEST(FindExtent, LeavesOutCamerasFarFromAllOthersAndSaysSo) {
  const TemporaryFolder folder;
  const Scene scene = with_photographs(small_images(strip(6)), on_ground, folder);
  Scene expected = scene;
  expected.views.resize(4);
  ASSERT_TRUE(find_extent(expected));
  for (const double far : {60.0, 1e4, 1e9}) {
    Scene wrong = scene;
    put(wrong.views[4], {far, -far, far});
    put(wrong.views[5], {0, far, -2 * far});
    wrong.views[5].image_name = "f.png";
    const auto found = find_extent(wrong);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(wrong.views.size(), 4U);
    EXPECT_EQ(wrong.bounds.low, expected.bounds.low);
    EXPECT_EQ(wrong.bounds.high, expected.bounds.high);
    ASSERT_EQ(wrong.notes.size(), 1U);
    EXPECT_NE(wrong.notes[0].find("2 of 6 cameras"), std::string::npos) << wrong.notes[0];
    EXPECT_NE(wrong.notes[0].find("f.png; they are left out"), std::string::npos) << wrong.notes[0];
  }
}

TEST(FindExtent, OfACameraFarAwayThatLooksAtTheOthersIsThatOfTheOthers) {
  const TemporaryFolder folder;
  const Scene scene = with_photographs(small_images(strip(6)), on_ground, folder);
  Scene expected = scene;
  expected.views.pop_back();
  ASSERT_TRUE(find_extent(expected));
  Scene wrong = scene;
  wrong.views[5].camera.camera_from_world = looking(180);
  put(wrong.views[5], {5e3, 0, 8});
  ASSERT_TRUE(find_extent(wrong));
  EXPECT_EQ(wrong.views.size(), 5U);
  EXPECT_EQ(wrong.bounds.high, expected.bounds.high) << "not one that holds what the far one sees";
}

TEST(FindExtent, NamesFarCamerasWhereTooFewAreLeft) {
  const TemporaryFolder folder;
  Scene scene = with_photographs(small_images(strip(3)), on_ground, folder);
  put(scene.views[1], {1e5, 0, 0});
  scene.views[1].image_name = "far.png";
  const auto found = find_extent(scene);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().kind, ErrorKind::kInput);
  for (const char* part : {"1 of 3 cameras", "far.png", "wrong poses", "bounds"})
    EXPECT_NE(found.error().message.find(part), std::string::npos) << found.error().message;
}

TEST(FindRangesInside, GivesThemToCamerasThatStandInTheBox) {
  const TemporaryFolder folder;
  Scene scene = with_photographs(small_images(room(30), 6), on_walls, folder);
  ASSERT_TRUE(find_ranges_inside(scene));
  for (const View& view : scene.views) {
    EXPECT_GT(view.near_depth, 1.0);
    EXPECT_LT(view.near_depth, 2.2);
    EXPECT_GT(view.far_depth, 2.2);
    EXPECT_LT(view.far_depth, 6.0);
  }
  Scene outside = orbit(8);
  EXPECT_TRUE(find_ranges_inside(outside)) << "reads no photograph";
}

}  // namespace
}  // namespace quorum
