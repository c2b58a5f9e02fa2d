#include "engine/synthetic/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace quorum {
namespace {

using Eigen::Vector3d;

const Solid kBox = Box{{Vector3d(-1, 0, -2), Vector3d(1, 3, 2)}};
const Solid kShaft = Drum{Vector3d(0.2, 0.1, -0.3), 3, 1.0, 0.8};
const Solid kFlared = Drum{Vector3d(0.2, 0.1, -0.3), 1, 0.5, 1.5};  // slope 1: many rays are steeper than its cone
const Solid kGable = Gable{{Vector3d(-2, 1, -1), Vector3d(2, 3, 1)}};
const Solid kAll[] = {kBox, kShaft, kFlared, kGable};

Vector3d random_vector(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> uniform(-reach, reach);
  const double x = uniform(random);
  const double y = uniform(random);
  return {x, y, uniform(random)};
}

/// The first of many steps along the ray that lies inside, or a negative number.
double march(const Solid& solid, const Ray& ray, double step, double end) {
  for (double t = 0; t < end; t += step)
    if (contains(solid, ray.origin + t * ray.direction, 0)) return t;
  return -1;
}

TEST(Shapes, BoxIsHitAtItsFace) {
  const auto hit = intersect(kBox, {Vector3d(0.5, 1, 10), Vector3d(0, 0, -2)});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->t, 4);
  EXPECT_EQ(hit->normal, Vector3d(0, 0, 1));
}

TEST(Shapes, DrumIsHitAtItsTaperedSide) {
  const auto hit = intersect(kShaft, {Vector3d(10.2, 1.6, -0.3), Vector3d(-1, 0, 0)});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->t, 10 - 0.9);
  EXPECT_TRUE(hit->normal.isApprox(Vector3d(3, 0.2, 0).normalized()));
}

TEST(Shapes, GableIsHitAtItsSlope) {
  const auto hit = intersect(kGable, {Vector3d(1, 10, 0), Vector3d(0, -1, 0)});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->t, 8);
  EXPECT_TRUE(hit->normal.isApprox(Vector3d(1, 1, 0).normalized()));
}

TEST(Shapes, RaysAgreeWithMarchingThroughTheInside) {
  constexpr double kStep = 0.002;
  constexpr double kDepth = 1e-7;
  std::mt19937 random(7);
  int hits = 0;
  int misses = 0;
  for (const Solid& solid : kAll) {
    for (int i = 0; i < 400; ++i) {
      Ray ray{random_vector(random, 4), {}};
      if (contains(solid, ray.origin, 0.01)) continue;
      ray.direction = (random_vector(random, 1.5) + Vector3d(0, 1, 0) - ray.origin).normalized();
      if (i % 10 == 0) ray.direction = Vector3d(0, ray.origin.y() > 0 ? -1 : 1, 0);
      const auto hit = intersect(solid, ray);
      const double marched = march(solid, ray, kStep, 12);
      if (!hit) {
        ++misses;
        EXPECT_LT(marched, 0) << "solid " << solid.index() << " ray " << i;
        continue;
      }
      ++hits;
      const Vector3d point = ray.origin + hit->t * ray.direction;
      if (marched >= 0) {  // a corner shorter than a step may be stepped over
        EXPECT_NEAR(hit->t, marched, kStep) << "solid " << solid.index() << " ray " << i;
      }
      EXPECT_NEAR(hit->normal.norm(), 1, 1e-12);
      EXPECT_LT(hit->normal.dot(ray.direction), 0);
      EXPECT_FALSE(contains(solid, point + kDepth * hit->normal, 0)) << "solid " << solid.index() << " ray " << i;
      EXPECT_TRUE(contains(solid, point + 1e-12 * ray.direction, 1e-9)) << "solid " << solid.index() << " ray " << i;
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(misses, 100);
}

TEST(Shapes, RaysFromInsideOrAwayHitNothing) {
  for (const Solid& solid : kAll) {
    const Vector3d center = bounds_of(solid).center();
    EXPECT_FALSE(intersect(solid, {center, Vector3d(0.3, 0.5, 0.8)}));
    EXPECT_FALSE(intersect(solid, {center + Vector3d(0, 0, 9), Vector3d(0, 0, 1)}));
  }
}

TEST(Shapes, ToleranceMovesTheBorderOfTheInside) {
  for (const Solid& solid : kAll) {
    const Bounds bounds = bounds_of(solid);
    const Vector3d bottom(bounds.center().x(), bounds.low.y(), bounds.center().z());
    EXPECT_TRUE(contains(solid, bottom, 0));
    EXPECT_FALSE(contains(solid, bottom, -1e-6));
    EXPECT_FALSE(contains(solid, bottom - Vector3d(0, 2e-6, 0), 1e-6));
    EXPECT_TRUE(contains(solid, bottom - Vector3d(0, 1e-6, 0), 2e-6));
  }
}

}  // namespace
}  // namespace quorum
