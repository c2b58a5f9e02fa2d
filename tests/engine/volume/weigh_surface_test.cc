#include "engine/volume/weigh_surface.h"

#include <gtest/gtest.h>

#include "tests/engine/volume/plane_input.h"

namespace quorum {
namespace {

constexpr int kWeighSide = 31;
constexpr int kWeighCenter = kWeighSide / 2;

Grid<std::uint32_t> words_of_surface(const Camera& camera, const Grid<float>& depth, float confidence,
                                     const FusionOptions& options) {
  const auto cells = range_surface(depth, make_range_surface_params(camera, depth.width, depth.height, options));
  return weigh_surface(depth, Grid<float>(depth.width, depth.height, confidence), cells,
                       make_weigh_surface_params(camera, depth.width, depth.height, options));
}

/// The weights without the cosines.
Grid<std::uint32_t> weigh(const Camera& camera, const Grid<float>& depth, float confidence,
                          const FusionOptions& options) {
  Grid<std::uint32_t> weights = words_of_surface(camera, depth, confidence, options);
  for (std::uint32_t& word : weights.values) word &= kWeightScale;
  return weights;
}

TEST(WeighSurface, AFacingPlaneOfFullConfidenceHasFullWeightWithin) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 1000);
  const auto weights = weigh(camera, Grid<float>(kWeighSide, kWeighSide, 2.0F), 1.0F, {});
  const int feather = FusionOptions{}.feather;
  for (int y = feather; y < kWeighSide - feather; ++y)
    for (int x = feather; x < kWeighSide - feather; ++x) EXPECT_EQ(weights.at(x, y), 255U) << x << " " << y;
}

TEST(WeighSurface, TheWeightIsTheCosineOfTheAngleToTheLineOfSight) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 200);
  FusionOptions options;
  options.max_slope_deg = 85;
  options.feather = 2;
  for (const double angle : {0.0, 30.0, 60.0, -60.0, 75.0}) {
    const double radians = angle * std::numbers::pi / 180.0;
    const auto weights = weigh(camera, plane_depth(camera, kWeighSide, kWeighSide, 2.0, angle), 1.0F, options);
    for (int y = 5; y < kWeighSide - 5; ++y) {
      for (int x = 5; x < kWeighSide - 5; ++x) {
        const double rx = (x - kWeighCenter) / 200.0;
        const double ry = (y - kWeighCenter) / 200.0;
        const double cosine = (std::cos(radians) - rx * std::sin(radians)) / std::sqrt(rx * rx + ry * ry + 1.0);
        EXPECT_NEAR(weights.at(x, y), 255 * cosine, 1.5) << angle << " degrees at " << x << " " << y;
      }
    }
  }
}

TEST(WeighSurface, DistancesAreTakenAlongTheNormalUnlessTheLineOfSightIsAskedFor) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 1000);
  FusionOptions options;
  options.weigh_slant = false;
  for (const double angle : {0.0, 45.0, 60.0}) {
    const auto depth = plane_depth(camera, kWeighSide, kWeighSide, 2.0, angle);
    options.signed_distance = SignedDistance::kNormal;
    const double expected = std::cos(angle * std::numbers::pi / 180.0);
    const auto along_normal = words_of_surface(camera, depth, 1.0F, options);
    EXPECT_NEAR((along_normal.at(kWeighCenter, kWeighCenter) >> kWeightBits) / static_cast<double>(kCosineScale),
                expected, 2e-3);
    options.signed_distance = SignedDistance::kRay;
    EXPECT_EQ(words_of_surface(camera, depth, 1.0F, options).at(kWeighCenter, kWeighCenter) >> kWeightBits,
              static_cast<std::uint32_t>(kCosineScale));
  }
}

TEST(WeighSurface, SixtyDegreesHalveTheWeight) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 1000);
  const auto facing = weigh(camera, plane_depth(camera, kWeighSide, kWeighSide, 2.0, 0), 1.0F, {});
  const auto grazing = weigh(camera, plane_depth(camera, kWeighSide, kWeighSide, 2.0, 60), 1.0F, {});
  EXPECT_NEAR(grazing.at(kWeighCenter, kWeighCenter), 0.5 * facing.at(kWeighCenter, kWeighCenter), 1.0);
}

TEST(WeighSurface, WeightsRiseFromTheBorderOverTheFeather) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 1000);
  for (const int feather : {1, 4, 8}) {
    FusionOptions options;
    options.feather = feather;
    const auto weights = weigh(camera, Grid<float>(kWeighSide, kWeighSide, 2.0F), 1.0F, options);
    for (int x = 0; x < feather; ++x) {
      EXPECT_LT(weights.at(x, kWeighCenter), weights.at(x + 1, kWeighCenter)) << "left, feather " << feather;
      EXPECT_LT(weights.at(kWeighCenter, x), weights.at(kWeighCenter, x + 1)) << "top, feather " << feather;
      EXPECT_EQ(weights.at(x, kWeighCenter), weights.at(kWeighSide - 1 - x, kWeighCenter))
          << "right, feather " << feather;
      EXPECT_EQ(weights.at(x, kWeighCenter), weights.at(kWeighCenter, kWeighSide - 1 - x))
          << "bottom, feather " << feather;
    }
    EXPECT_EQ(weights.at(feather, kWeighCenter), 255U);
  }
}

TEST(WeighSurface, AHoleIsABorderToo) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 1000);
  Grid<float> depth(kWeighSide, kWeighSide, 2.0F);
  depth.at(kWeighCenter, kWeighCenter) = 0.0F;
  FusionOptions options;
  options.feather = 4;
  const auto weights = weigh(camera, depth, 1.0F, options);
  EXPECT_EQ(weights.at(kWeighCenter, kWeighCenter), 0U);
  for (int x = kWeighCenter + 1; x < kWeighCenter + 4; ++x)
    EXPECT_LT(weights.at(x, kWeighCenter), weights.at(x + 1, kWeighCenter));
}

TEST(WeighSurface, NoFeatherMeansFullWeightAtTheBorder) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 1000);
  FusionOptions options;
  options.feather = 0;
  for (const std::uint32_t weight : weigh(camera, Grid<float>(kWeighSide, kWeighSide, 2.0F), 1.0F, options).values)
    EXPECT_EQ(weight, 255U);
}

TEST(WeighSurface, IsProportionalToTheConfidence) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 500);
  const auto depth = plane_depth(camera, kWeighSide, kWeighSide, 2.0, 40);
  const auto full = weigh(camera, depth, 1.0F, {});
  for (const float confidence : {0.25F, 0.5F, 0.9F}) {
    const auto weights = weigh(camera, depth, confidence, {});
    for (std::size_t i = 0; i < full.values.size(); ++i)
      EXPECT_NEAR(weights.values[i], confidence * static_cast<float>(full.values[i]), 1.01);
  }
}

TEST(WeighSurface, FactorsCanBeLeftOut) {
  const Camera camera = straight_camera(kWeighSide, kWeighSide, 1000);
  const auto grazing = plane_depth(camera, kWeighSide, kWeighSide, 2.0, 60);
  FusionOptions options;
  options.feather = 4;
  EXPECT_NEAR(weigh(camera, grazing, 0.5F, options).at(kWeighCenter, kWeighCenter), 64, 1);
  options.weigh_confidence = false;
  EXPECT_NEAR(weigh(camera, grazing, 0.5F, options).at(kWeighCenter, kWeighCenter), 128, 1);
  options.weigh_slant = false;
  EXPECT_EQ(weigh(camera, grazing, 0.5F, options).at(kWeighCenter, kWeighCenter), 255U);
  EXPECT_LT(weigh(camera, grazing, 0.5F, options).at(0, kWeighCenter), 20U);
  options.weigh_border = false;
  EXPECT_EQ(weigh(camera, grazing, 0.5F, options).at(0, kWeighCenter), 255U);
}

TEST(WeighSurface, IsZeroOffTheSurfaceAndAtLeastOneOnIt) {
  const Camera camera = straight_camera(9, 9, 1000);
  Grid<float> depth(9, 9, 0.0F);
  depth.at(1, 1) = 2.0F;                                    // alone
  depth.at(5, 1) = depth.at(6, 1) = 2.0F;                   // a pair
  depth.at(4, 5) = depth.at(5, 5) = depth.at(4, 6) = 2.0F;  // a triangle
  const auto weights = weigh(camera, depth, 1e-4F, {});
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool corner = (x == 4 && y == 5) || (x == 5 && y == 5) || (x == 4 && y == 6);
      EXPECT_EQ(weights.at(x, y), corner ? 1U : 0U) << x << " " << y;
    }
  }
}

TEST(WeighSurface, TheSmallestMapsHaveNoWeight) {
  const Camera camera = straight_camera(1, 1, 100);
  EXPECT_TRUE(weigh(camera, {}, 1.0F, {}).empty());
  EXPECT_EQ(weigh(camera, Grid<float>(1, 1, 2.0F), 1.0F, {}).values, std::vector<std::uint32_t>(1));
}

}  // namespace
}  // namespace quorum
