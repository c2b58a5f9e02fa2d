#include "engine/synthetic/stone_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace quorum {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> points_in_temple(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.08, 0.08);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double x = uniform(random);
    const double y = uniform(random);
    points.emplace_back(x, y, uniform(random));
  }
  return points;
}

TEST(StoneTexture, ReflectanceStaysPhysicalAtAnyStrength) {
  for (const double strength : {0.0, 1.0, 4.0}) {
    for (const Vector3d& point : points_in_temple(5000)) {
      const Vector3d color = stone_reflectance(point, strength, 1);
      EXPECT_GT(color.minCoeff(), 0);
      EXPECT_LE(color.maxCoeff(), 1);
    }
  }
}

TEST(StoneTexture, StrengthZeroIsPlainPlaster) {
  const Vector3d plaster = stone_reflectance(Vector3d::Zero(), 0, 1);
  for (const Vector3d& point : points_in_temple(100)) EXPECT_EQ(stone_reflectance(point, 0, 2), plaster);
}

TEST(StoneTexture, OtherSeedIsOtherStone) {
  const Vector3d point(0.01, 0.02, 0.03);
  EXPECT_EQ(stone_reflectance(point, 1, 5), stone_reflectance(point, 1, 5));
  EXPECT_NE(stone_reflectance(point, 1, 5), stone_reflectance(point, 1, 6));
}

TEST(StoneTexture, ColorVariesWithoutJumps) {
  for (const Vector3d& point : points_in_temple(2000)) {
    const Vector3d step(1e-6, -1e-6, 1e-6);
    EXPECT_LT((stone_reflectance(point, 1, 1) - stone_reflectance(point + step, 1, 1)).norm(), 0.01);
  }
}

TEST(StoneTexture, ChannelsAreNotProportional) {
  double lowest = 10;
  double highest = 0;
  for (const Vector3d& point : points_in_temple(500)) {
    const Vector3d color = stone_reflectance(point, 1, 1);
    lowest = std::min(lowest, color.x() / color.z());
    highest = std::max(highest, color.x() / color.z());
  }
  EXPECT_GT(highest / lowest, 1.1);
}

TEST(StoneTexture, WindowsOfTwoMillimetersHaveTheContrastOfPhotographs) {
  std::vector<double> contrasts;
  for (const Vector3d& point : points_in_temple(500)) {
    double sum = 0;
    double sum_of_squares = 0;
    for (int i = 0; i < 25; ++i) {
      const double value = stone_reflectance(point + 0.0004 * Vector3d(i % 5, i / 5, 0), 1, 1).y();
      sum += value;
      sum_of_squares += value * value;
    }
    contrasts.push_back(std::sqrt(std::max(0.0, sum_of_squares / 25 - sum * sum / 625)) / (sum / 25));
  }
  std::ranges::sort(contrasts);
  EXPECT_GT(contrasts[250], 0.06);
  EXPECT_LT(contrasts[250], 0.12);
}

}  // namespace
}  // namespace quorum
