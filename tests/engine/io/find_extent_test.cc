#include "engine/io/find_extent.h"

#include <gtest/gtest.h>

#include "engine/io/image_file.h"
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
