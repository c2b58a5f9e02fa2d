#include "engine/render/render_points.h"

#include <gtest/gtest.h>

#include <limits>

namespace quorum {
namespace {

using Shading = RenderOptions::Shading;

constexpr Rgba kBackground = make_rgb(255, 255, 255);

Camera points_camera() {
  Camera camera;
  camera.intrinsics << 50, 0, 10, 0, 50, 8, 0, 0, 1;
  camera.translation = {0.3, -0.2, 0.5};
  return camera;
}

/// A point seen at a pixel, with its normal in camera axes.
Vertex point_at(double x, double y, double depth, const Eigen::Vector3f& normal = {0, 0, -1}) {
  return {points_camera().unproject(x, y, depth).cast<float>(), normal, make_rgb(200, 100, 40), 1.0F};
}

ColorImage render(const Mesh& cloud, Shading shading = Shading::kColor) {
  return render_points(cloud, points_camera(), 20, 16, {.shading = shading}).value();
}

TEST(RenderPoints, APointIsASquareOfThreeSamples) {
  // 5.25 is the second sample of pixel 5, so the square has both samples of that pixel and the first of the next one.
  const ColorImage image = render({{point_at(5.25, 7.25, 2)}, {}});
  EXPECT_EQ(image.at(5, 7), make_rgb(200, 100, 40));
  EXPECT_EQ(image.at(6, 7), make_rgb(228, 178, 148));
  EXPECT_EQ(image.at(5, 8), make_rgb(228, 178, 148));
  int colored = 0;
  for (const Rgba pixel : image.values) colored += pixel != kBackground ? 1 : 0;
  EXPECT_EQ(colored, 4);
}

TEST(RenderPoints, TheNearerPointHidesTheOther) {
  Mesh cloud{{point_at(5.25, 7.25, 2), point_at(5.25, 7.25, 3)}, {}};
  cloud.vertices[1].color = make_rgb(1, 2, 3);
  EXPECT_EQ(render(cloud).at(5, 7), make_rgb(200, 100, 40));
  std::swap(cloud.vertices[0], cloud.vertices[1]);
  EXPECT_EQ(render(cloud).at(5, 7), make_rgb(200, 100, 40));
}

TEST(RenderPoints, PointsThatTurnAwayAreBluer) {
  const ColorImage front = render({{point_at(5.25, 7.25, 2)}, {}}, Shading::kShaded);
  const ColorImage back = render({{point_at(5.25, 7.25, 2, {0, 0, 1})}, {}}, Shading::kShaded);
  const ColorImage unknown = render({{point_at(5.25, 7.25, 2, {0, 0, 0})}, {}}, Shading::kShaded);
  EXPECT_EQ(red_of(front.at(5, 7)), blue_of(front.at(5, 7)));
  EXPECT_EQ(red_of(unknown.at(5, 7)), blue_of(unknown.at(5, 7)));
  EXPECT_LT(red_of(back.at(5, 7)) + 50, blue_of(back.at(5, 7)));
}

TEST(RenderPoints, WhatIsNotBeforeTheCameraIsLeftOut) {
  Mesh cloud{{point_at(5, 7, -2), point_at(1e9, 7, 2), point_at(-40, 7, 2)}, {}};
  cloud.vertices.push_back(point_at(5, 7, 2));
  cloud.vertices.back().position.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(render(cloud), ColorImage(20, 16, kBackground));
  EXPECT_EQ(render({}), ColorImage(20, 16, kBackground));
  EXPECT_TRUE(render_points({}, points_camera(), 0, 0, {}).value().empty());
  EXPECT_EQ(render_points({}, points_camera(), 4, 4, {.full_confidence = -1}).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace quorum
