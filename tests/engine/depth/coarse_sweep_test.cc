#include "engine/depth/coarse_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/scene/camera_paths.h"
#include "tests/engine/scene/path_images.h"

namespace quorum {
namespace {

ImageReader reader_of(const Scene& scene, const Surface& surface) {
  std::vector<PaddedImage> images;
  for (const View& view : scene.views) images.push_back(pad_image(image_of(view, surface)));
  return [images](int index) -> Expected<PaddedImage> { return images[static_cast<std::size_t>(index)]; };
}

TEST(CoarseSweep, FindsTheGroundUnderAStrip) {
  const Scene scene = small_images(strip(4));
  const auto points = coarse_sweep(scene, reader_of(scene, on_ground));
  ASSERT_TRUE(points);
  ASSERT_GT(points->size(), 2000U);
  const auto off = std::ranges::count_if(*points, [](const SparsePoint& p) { return std::abs(p.position.z()) > 0.3; });
  EXPECT_LT(static_cast<double>(off), 0.05 * static_cast<double>(points->size()));
  for (const SparsePoint& point : *points) {
    EXPECT_GE(point.views.size(), 2U);
    EXPECT_TRUE(std::ranges::is_sorted(point.views));
  }
}

TEST(CoarseSweep, FindsTheWallsOfARoomAroundTheCameras) {
  const Scene scene = small_images(room(30), 8);
  const auto points = coarse_sweep(scene, reader_of(scene, on_walls));
  ASSERT_TRUE(points);
  ASSERT_GT(points->size(), 4000U);
  const auto off = std::ranges::count_if(
      *points, [](const SparsePoint& p) { return std::abs(p.position.cwiseAbs().maxCoeff() - 3.0) > 0.3; });
  EXPECT_LT(static_cast<double>(off), 0.02 * static_cast<double>(points->size()));
}

TEST(CoarseSweep, FollowsTheScale) {
  Scene scene = small_images(strip(4));
  const auto points = coarse_sweep(scene, reader_of(scene, on_ground));
  const Scene once = scene;
  for (View& view : scene.views) view.camera.translation *= 1024.0;
  const auto larger = coarse_sweep(scene, reader_of(once, on_ground));
  ASSERT_TRUE(points && larger);
  ASSERT_EQ(points->size(), larger->size());
  EXPECT_LT((points->front().position * 1024.0 - larger->front().position).norm(), 0.1);
}

TEST(CoarseSweep, FindsNothingFromOnePlace) {
  for (const int views : {0, 1, 2, 5}) {
    const Scene scene = small_images(turn(views));
    const auto points = coarse_sweep(scene, reader_of(scene, on_walls));
    ASSERT_TRUE(points);
    EXPECT_TRUE(points->empty()) << views;
  }
  Scene scene = small_images(turn(5));
  for (std::size_t view = 0; view < 5; ++view)
    scene.views[view].camera.translation.x() += view % 2 == 0 ? 0.003 : -0.003;
  const auto points = coarse_sweep(scene, reader_of(scene, on_walls));
  ASSERT_TRUE(points);
  EXPECT_TRUE(points->empty()) << "not quite one place";
}

TEST(CoarseSweep, PassesOnWhatTheReaderSays) {
  const Scene scene = small_images(strip(4));
  const auto points =
      coarse_sweep(scene, [](int) -> Expected<PaddedImage> { return failure(ErrorKind::kInput, "a.png: is damaged"); });
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().message, "a.png: is damaged");
}

}  // namespace
}  // namespace quorum
