#include "engine/volume/range_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/engine/volume/plane_input.h"
#include "tests/support/range_params.h"

namespace quorum {
namespace {

constexpr std::uint32_t kBoth = kCellFirstTriangle | kCellSecondTriangle;

/// The one cell of a 2 x 2 map.
std::uint32_t cell_of(float d0, float d1, float d2, float d3, float max_step = 0.1F) {
  Grid<float> depth(2, 2);
  depth.values = {d0, d1, d2, d3};
  return range_surface(depth, slope_alone(2, 2, max_step)).at(0, 0);
}

TEST(RangeSurface, AFlatMapHasAllTriangles) {
  const auto cells = range_surface(Grid<float>(7, 5, 2.0F), slope_alone(7, 5, 0.01F));
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) EXPECT_EQ(cells.at(x, y), x < 6 && y < 4 ? kBoth : 0U) << x << " " << y;
}

TEST(RangeSurface, ADepthJumpIsNotSpanned) {
  Grid<float> depth(8, 6, 2.0F);
  for (int y = 0; y < 6; ++y)
    for (int x = 4; x < 8; ++x) depth.at(x, y) = 3.0F;
  const auto cells = range_surface(depth, slope_alone(8, 6, 0.05F));
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) EXPECT_EQ(cells.at(x, y), x == 3 ? 0U : kBoth) << x << " " << y;
}

TEST(RangeSurface, TheSlopeOptionDecides) {
  const Camera camera = straight_camera(9, 9, 1000.0);
  FusionOptions options;
  options.max_slope_deg = 70;
  const RangeSurfaceParams params = make_range_surface_params(camera, 9, 9, options);
  const auto flatter = range_surface(plane_depth(camera, 9, 9, 2.0, 68), params);
  const auto steeper = range_surface(plane_depth(camera, 9, 9, 2.0, 72), params);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(flatter.at(x, y) & kBoth, kBoth);
      EXPECT_EQ(steeper.at(x, y), 0U);
    }
  }
}

/// A wall that turns away by so many degrees, with its own normal at each pixel or another one.
struct Wall {
  explicit Wall(double degrees, double normal_degrees)
      : camera(straight_camera(9, 9, 1000.0)), depth(plane_depth(camera, 9, 9, 2.0, degrees)) {
    const double angle = normal_degrees * std::numbers::pi / 180.0;
    normals =
        pack_normals(Grid<Eigen::Vector3f>(9, 9, Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle)).cast<float>()));
  }
  [[nodiscard]] bool is_joined(double max_slope, double agreement) const {
    FusionOptions options;
    options.max_slope_deg = max_slope;
    options.plane_agreement = agreement;
    const auto cells = range_surface(depth, make_range_surface_params(camera, 9, 9, options), normals);
    return (cells.at(4, 4) & kBoth) == kBoth;
  }
  Camera camera;
  Grid<float> depth;
  Grid<std::uint32_t> normals;
};

TEST(RangeSurface, ASteepWallGoesOnWhereItsPlanesSaySo) {
  const Wall grazing(72, 72);
  EXPECT_TRUE(grazing.is_joined(75, 1));
  EXPECT_TRUE(grazing.is_joined(75, 0));
  EXPECT_FALSE(grazing.is_joined(70, 1));  // no plane joins what is too steep
}

TEST(RangeSurface, AStepBetweenPlanesThatDoNotMeetIsBroken) {
  const Wall step(72, 0);  // each pixel lies on a plane of its own that faces the camera
  EXPECT_FALSE(step.is_joined(75, 1));
  EXPECT_TRUE(step.is_joined(75, 0));
  EXPECT_TRUE(step.is_joined(75, 4));           // tan 72 degrees is 3.1 footprints
  EXPECT_TRUE(Wall(35, 0).is_joined(75, 0.1));  // too flat to be asked
}

TEST(RangeSurface, APixelWithoutAPlaneObjectsToNothing) {
  Wall step(72, 0);
  step.normals = Grid<std::uint32_t>(9, 9, 0U);
  EXPECT_TRUE(step.is_joined(75, 1));
}

TEST(RangeSurface, PackedNormalsAreThoseWithinAThousandth) {
  Grid<Eigen::Vector3f> normals(2, 1, Eigen::Vector3f::Zero());
  normals.values[1] = Eigen::Vector3f(-0.48F, 0.6F, -0.64F);
  const auto packed = pack_normals(normals);
  EXPECT_EQ(packed.values[0], 0U);
  for (int axis = 0; axis < 3; ++axis) {
    const auto bits = packed.values[1] >> (axis * kNormalBits) & ((1U << kNormalBits) - 1);
    EXPECT_NEAR((static_cast<double>(bits) - kNormalZero) / kNormalScale, double{normals.values[1][axis]}, 0.001);
  }
}

TEST(RangeSurface, ALoneSampleOrAPairFormsNoTriangle) {
  EXPECT_EQ(cell_of(2, 0, 0, 0), 0U);
  EXPECT_EQ(cell_of(0, 0, 2, 0), 0U);
  EXPECT_EQ(cell_of(2, 2, 0, 0), 0U);
  EXPECT_EQ(cell_of(2, 0, 0, 2), 0U);
  EXPECT_EQ(cell_of(0, 2, 2, 0), 0U);
  EXPECT_EQ(cell_of(0, 0, 0, 0), 0U);
}

TEST(RangeSurface, ThreeSamplesFormOneTriangle) {
  EXPECT_EQ(cell_of(0, 2, 2, 2), kCellSecondTriangle);
  EXPECT_EQ(cell_of(2, 2, 2, 0), kCellFirstTriangle);
  EXPECT_EQ(cell_of(2, 0, 2, 2), kCellSecondTriangle | kCellSplitAlong03);
  EXPECT_EQ(cell_of(2, 2, 0, 2), kCellFirstTriangle | kCellSplitAlong03);
}

TEST(RangeSurface, AnOutlierLeavesTheTriangleBesideIt) {
  EXPECT_EQ(cell_of(9, 2, 2, 2), kCellSecondTriangle);
  EXPECT_EQ(cell_of(2, 2, 2, 9), kCellFirstTriangle);
  EXPECT_EQ(cell_of(2, 9, 2, 2), kCellSecondTriangle | kCellSplitAlong03);
  EXPECT_EQ(cell_of(2, 2, 9, 2), kCellFirstTriangle | kCellSplitAlong03);
}

TEST(RangeSurface, CellsAreSplitAlongTheShorterDiagonal) {
  EXPECT_EQ(cell_of(2.0F, 2.05F, 1.95F, 2.0F), kBoth | kCellSplitAlong03);
  EXPECT_EQ(cell_of(2.05F, 2.0F, 2.0F, 1.95F), kBoth);
  EXPECT_EQ(cell_of(2, 2, 2, 2), kBoth);
}

TEST(RangeSurface, TheSmallestMapsHaveNoCell) {
  EXPECT_TRUE(range_surface({}, slope_alone(0, 0, 0.1F)).empty());
  EXPECT_EQ(range_surface(Grid<float>(1, 1, 2.0F), slope_alone(1, 1, 0.1F)).values, std::vector<std::uint32_t>(1));
  EXPECT_EQ(range_surface(Grid<float>(5, 1, 2.0F), slope_alone(5, 1, 0.1F)).values, std::vector<std::uint32_t>(5));
  EXPECT_EQ(range_surface(Grid<float>(1, 5, 2.0F), slope_alone(1, 5, 0.1F)).values, std::vector<std::uint32_t>(5));
}

}  // namespace
}  // namespace quorum
