#include "engine/evaluate/color_by_error.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

/// A large square in the plane z = 0.
Mesh ground() {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair{-10.0F, -10.0F}, {10.0F, -10.0F}, {10.0F, 10.0F}, {-10.0F, 10.0F}})
    mesh.vertices.push_back({.position = {x, y, 0.0F}});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A cloud above the ground at these heights.
Mesh points_at(const std::vector<float>& heights) {
  Mesh mesh;
  for (const float height : heights) mesh.vertices.push_back({.position = {0.5F, 0.25F, height}, .confidence = 2.0F});
  return mesh;
}

TEST(ColorByError, GoesFromBlueOverGreenAndYellowToRed) {
  const Mesh colored = color_by_error(points_at({0.0F, 1.0F, -2.0F, 3.0F}), ground(), 3.0).value();
  const auto color = [&](std::size_t v) { return colored.vertices[v].color; };
  EXPECT_GT(blue_of(color(0)), red_of(color(0)) + 100);
  EXPECT_GT(green_of(color(1)), red_of(color(1)) + 50);
  EXPECT_GT(green_of(color(1)), blue_of(color(1)) + 50);
  EXPECT_GT(std::min(red_of(color(2)), green_of(color(2))), blue_of(color(2)) + 100);
  EXPECT_GT(red_of(color(3)), green_of(color(3)) + 100);
}

TEST(ColorByError, BeyondTheFullErrorEverythingIsRed) {
  const Mesh colored = color_by_error(points_at({1.0F, 50.0F}), ground(), 1.0).value();
  EXPECT_EQ(colored.vertices[0].color, colored.vertices[1].color);
}

TEST(ColorByError, ChangesNothingButTheColors) {
  const Mesh mesh = points_at({0.25F});
  const Mesh colored = color_by_error(mesh, ground(), 1.0).value();
  EXPECT_EQ(colored.vertices[0].position, mesh.vertices[0].position);
  EXPECT_EQ(colored.vertices[0].confidence, 2.0F);
  EXPECT_NE(colored.vertices[0].color, mesh.vertices[0].color);
  EXPECT_TRUE(color_by_error({}, ground(), 1.0).value().vertices.empty());
}

TEST(ColorByError, RefusesBadDistancesAndEmptyTruth) {
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(color_by_error(points_at({0.0F}), ground(), bad).error().kind, ErrorKind::kUsage);
  EXPECT_EQ(color_by_error(points_at({0.0F}), {}, 1.0).error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace quorum
