#include "engine/camera/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/camera/pinhole_picture.h"

namespace quorum {
namespace {

Lens make_lens(Lens::Model model, std::array<double, 12> coefficients) {
  Lens lens;
  lens.model = model;
  lens.width = 640;
  lens.height = 480;
  lens.focal = {500, 510};
  lens.principal = {321, 238};
  lens.coefficients = coefficients;
  return lens;
}

const Lens kBarrel = make_lens(Lens::Model::kRadial, {-0.2, 0.05, 0.001, -0.002});
const Lens kPincushion = make_lens(Lens::Model::kRadial, {0.2, 0.05, 0.001, -0.002, 0.01, 0.01, 0.02, 0.03});
const Lens kFisheye = make_lens(Lens::Model::kFisheye, {0.02, -0.01, 0.003, -0.001});
const Lens kOthers[] = {
    make_lens(Lens::Model::kRadial, {-0.1, 0.02, 0, 0, 0.01, 0, 0, 0, 0.002}),
    make_lens(Lens::Model::kFisheye, {}),
    make_lens(Lens::Model::kThinPrismFisheye, {0.02, -0.01, 0.001, -0.002, 0.003, -0.001, 0.002, -0.001}),
    make_lens(Lens::Model::kRadTanThinPrismFisheye,
              {0.02, -0.01, 0.003, -0.001, 0.0005, -0.0001, 0.001, -0.002, 0.002, -0.001, -0.001, 0.0005}),
    make_lens(Lens::Model::kFov, {0.9}),
    make_lens(Lens::Model::kDivision, {-0.2}),
    make_lens(Lens::Model::kDivision, {0.15}),
    make_lens(Lens::Model::kEucm, {0.6, 1.2}),
    make_lens(Lens::Model::kInverseRadial, {-0.2}),
    make_lens(Lens::Model::kInverseRadial, {0.3}),
};

TEST(Lens, RadialTermsBendAsTheFormulaSays) {
  const Lens lens = make_lens(Lens::Model::kRadial, {0.1, 0.01, 0, 0, 0.001});
  // r = 1 along x: 1 + 0.1 + 0.01 + 0.001.
  EXPECT_NEAR(lens.project({1, 0}).x(), 321 + 500 * 1.111, 1e-9);
  EXPECT_NEAR(lens.project({0, 1}).y(), 238 + 510 * 1.111, 1e-9);
  const Lens rational = make_lens(Lens::Model::kRadial, {0, 0, 0, 0, 0, 0.5, 0.25, 0.25});
  EXPECT_NEAR(rational.project({1, 0}).x(), 321 + 500 / 2.0, 1e-9);
  const Lens tangential = make_lens(Lens::Model::kRadial, {0, 0, 0.01, 0.02});
  EXPECT_NEAR(tangential.project({1, 2}).x(), 321 + 500 * (1 + 2 * 0.01 * 2 + 0.02 * (5 + 2)), 1e-9);
  EXPECT_NEAR(tangential.project({1, 2}).y(), 238 + 510 * (2 + 0.01 * (5 + 8) + 2 * 0.02 * 2), 1e-9);
}

TEST(Lens, VisualSfmsRayIsAPolynomialOfWhatIsSeen) {
  for (const double k : {-0.2, 0.3}) {
    const Lens lens = make_lens(Lens::Model::kInverseRadial, {k});
    EXPECT_NEAR(lens.project({0.5 * (1 + k * 0.25), 0}).x(), 321 + 500 * 0.5, 1e-9) << k;
    EXPECT_FALSE(lens.is_pinhole());
  }
  EXPECT_TRUE(make_lens(Lens::Model::kInverseRadial, {}).is_pinhole());
  // The fold of k = -0.2 shows the ray 0.86 at 1.29; no pixel shows one beyond.
  const Lens lens = make_lens(Lens::Model::kInverseRadial, {-0.2});
  EXPECT_FALSE(lens.unproject({321 + 500 * 1.3, 238}));
  EXPECT_FALSE(std::isfinite(lens.project({0.9, 0}).x()));
}

TEST(Lens, FisheyeShowsAnglesAsDistances) {
  const Lens lens = make_lens(Lens::Model::kFisheye, {});
  EXPECT_NEAR(lens.project({1, 0}).x(), 321 + 500 * std::atan(1.0), 1e-9);
  EXPECT_EQ(lens.project({0, 0}), lens.principal);
}

TEST(Lens, UnprojectUndoesProject) {
  for (const Lens& lens : {kBarrel, kPincushion, kFisheye}) {
    for (int y = 0; y < lens.height; y += 31) {
      for (int x = 0; x < lens.width; x += 37) {
        const auto ray = lens.unproject(Eigen::Vector2d(x, y));
        ASSERT_TRUE(ray) << x << " " << y;
        EXPECT_LT((lens.project(*ray) - Eigen::Vector2d(x, y)).norm(), 1e-6);
      }
    }
  }
}

TEST(Lens, EveryModelIsUndoneToABillionth) {
  for (const Lens& lens : kOthers) {
    double residual = 0.0;
    for (int y = 0; y < lens.height; y += 31) {
      for (int x = 0; x < lens.width; x += 37) {
        const auto ray = lens.unproject(Eigen::Vector2d(x, y));
        ASSERT_TRUE(ray) << static_cast<int>(lens.model) << ": " << x << " " << y;
        residual = std::max(residual, (lens.project(*ray) - Eigen::Vector2d(x, y)).norm());
      }
    }
    EXPECT_LT(residual, 1e-6) << static_cast<int>(lens.model);
    EXPECT_FALSE(lens.is_pinhole());
  }
}

TEST(Lens, ClosedFormsHold) {
  const auto bent = [](Lens::Model model, std::array<double, 12> coefficients, double x) {
    return (make_lens(model, coefficients).project({x, 0}).x() - 321) / 500;
  };
  // The field of view of a perfect lens: r = tan(bent omega) / (2 tan(omega / 2)).
  EXPECT_NEAR(bent(Lens::Model::kFov, {0.8}, std::tan(0.5 * 0.8) / (2 * std::tan(0.4))), 0.5, 1e-12);
  EXPECT_NEAR(bent(Lens::Model::kFov, {1e-9}, 0.7), 0.7, 1e-12);
  EXPECT_NEAR(bent(Lens::Model::kDivision, {-0.2}, 0.5 / (1 - 0.2 * 0.25)), 0.5, 1e-12);
  EXPECT_NEAR(bent(Lens::Model::kDivision, {0.2}, 0.5 / (1 + 0.2 * 0.25)), 0.5, 1e-12);
  // With beta 1, alpha 1 / 2 it is the stereographic projection: tan of half the angle, times 2.
  EXPECT_NEAR(bent(Lens::Model::kEucm, {0.5, 1.0}, std::tan(1.0)), 2 * std::tan(0.5), 1e-12);
  // Without prisms, both are the fisheye.
  for (const double angle : {0.1, 0.7, 1.2}) {
    const double expected = angle * (1 + 0.02 * std::pow(angle, 2) - 0.01 * std::pow(angle, 4));
    EXPECT_NEAR(bent(Lens::Model::kFisheye, {0.02, -0.01}, std::tan(angle)), expected, 1e-12);
    EXPECT_NEAR(bent(Lens::Model::kThinPrismFisheye, {0.02, -0.01}, std::tan(angle)), expected, 1e-12);
    EXPECT_NEAR(bent(Lens::Model::kRadTanThinPrismFisheye, {0.02, -0.01}, std::tan(angle)), expected, 1e-12);
  }
  EXPECT_TRUE(make_lens(Lens::Model::kDivision, {}).is_pinhole());
  EXPECT_TRUE(make_lens(Lens::Model::kEucm, {0, 1}).is_pinhole());
}

TEST(Lens, WhatNoRayReachesHasNone) {
  // r (1 - r^2) is at most 0.385, at r = 0.577.
  const Lens lens = make_lens(Lens::Model::kRadial, {-1.0});
  const auto inside = lens.unproject({321 + 500 * 0.38, 238});
  ASSERT_TRUE(inside);
  EXPECT_LT(inside->x(), 0.578);
  EXPECT_FALSE(lens.unproject({321 + 500 * 0.39, 238}));
  EXPECT_FALSE(make_lens(Lens::Model::kFisheye, {}).unproject({321 + 500 * 1.6, 238})) << "behind the camera";
  EXPECT_FALSE(make_lens(Lens::Model::kFov, {0.9}).unproject({321 + 500 * 1.8, 238})) << "behind the camera";
  EXPECT_FALSE(make_lens(Lens::Model::kDivision, {-0.2}).unproject({321 + 500 * 2.3, 238})) << "behind the camera";
  EXPECT_FALSE(make_lens(Lens::Model::kEucm, {0.6, 1.2}).unproject({321 + 500 * 2.3, 238})) << "on no sphere";
}

TEST(PinholePicture, OfNoDistortionIsThePhotograph) {
  const auto picture = pinhole_picture(make_lens(Lens::Model::kRadial, {}));
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 640);
  EXPECT_EQ(picture->height, 480);
  EXPECT_NEAR(picture->intrinsics(0, 2), 321, 1e-9);
  EXPECT_NEAR(picture->intrinsics(1, 2), 238, 1e-9);
  EXPECT_EQ(picture->intrinsics(0, 0), 500);
  EXPECT_EQ(picture->intrinsics(1, 1), 510);
}

TEST(PinholePicture, ShowsNothingBeyondThePhotographAndMostOfIt) {
  std::vector<Lens> lenses = {kBarrel, kPincushion, kFisheye};
  lenses.insert(lenses.end(), std::begin(kOthers), std::end(kOthers));
  for (const Lens& lens : lenses) {
    const auto picture = pinhole_picture(lens);
    ASSERT_TRUE(picture);
    const Eigen::Matrix3d& k = picture->intrinsics;
    double least_gap = 1e9;
    for (int y = 0; y < picture->height; ++y) {
      for (int x = 0; x < picture->width; ++x) {
        const Eigen::Vector2d pixel = lens.project({(x - k(0, 2)) / k(0, 0), (y - k(1, 2)) / k(1, 1)});
        const double gap = std::min({pixel.x(), pixel.y(), lens.width - 1 - pixel.x(), lens.height - 1 - pixel.y()});
        least_gap = std::min(least_gap, gap);
      }
    }
    EXPECT_GT(least_gap, -0.05);
    EXPECT_LT(least_gap, 1.0);
  }
}

TEST(PinholePicture, StaysSmallWhereTheLensSeesHalfTheWorld) {
  Lens lens = make_lens(Lens::Model::kFisheye, {});
  lens.focal = {210, 210};  // 640 pixels are 175 degrees
  const auto picture = pinhole_picture(lens);
  ASSERT_TRUE(picture);
  EXPECT_LE(picture->width, 2 * 640);
  EXPECT_LE(picture->height, 2 * 480);
  EXPECT_GT(picture->width, 500);
  EXPECT_FALSE(pinhole_picture(make_lens(Lens::Model::kRadial, {-1e9})));
}

}  // namespace
}  // namespace quorum
