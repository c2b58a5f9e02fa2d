#include "engine/evaluate/distance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "engine/evaluate/triangle_distance.h"

namespace quorum {
namespace {

using Eigen::Vector3d;

Mesh cloud_of(const std::vector<Eigen::Vector3f>& positions) {
  Mesh mesh;
  for (const Eigen::Vector3f& position : positions) mesh.vertices.push_back({.position = position});
  return mesh;
}

/// Distance to a triangle by the seven Voronoi regions (Ericson, Real-Time Collision Detection, 2005), in long double:
/// another way than the code's. Flat triangles are the segments between their corners.
double reference_distance(const Vector3d& point, const std::array<Vector3d, 3>& corners) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const Vector p = point.cast<long double>();
  const std::array<Vector, 3> q = {corners[0].cast<long double>(), corners[1].cast<long double>(),
                                   corners[2].cast<long double>()};
  long double best = std::numeric_limits<long double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector along = q[(i + 1) % 3] - q[i];
    const long double square = along.squaredNorm();
    const long double t = square > 0 ? std::clamp((p - q[i]).dot(along) / square, 0.0L, 1.0L) : 0.0L;
    best = std::min(best, (p - q[i] - t * along).norm());
  }
  const Vector ab = q[1] - q[0];
  const Vector ac = q[2] - q[0];
  const Vector ap = p - q[0];
  const long double d00 = ab.dot(ab), d01 = ab.dot(ac), d11 = ac.dot(ac), d20 = ap.dot(ab), d21 = ap.dot(ac);
  const long double determinant = d00 * d11 - d01 * d01;
  if (determinant > 1e-15L * d00 * d11) {
    const long double v = (d11 * d20 - d01 * d21) / determinant;
    const long double w = (d00 * d21 - d01 * d20) / determinant;
    if (v >= 0 && w >= 0 && v + w <= 1) best = std::min(best, (ap - v * ab - w * ac).norm());
  }
  return static_cast<double>(best);
}

/// Random triangles, of which every fifth is a point, every fifth a segment and every fifth a sliver.
Mesh random_triangles(int count, float scale, const Eigen::Vector3f& offset) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto place = [&] { return Eigen::Vector3f(uniform(random), uniform(random), uniform(random)); };
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f a = place();
    Eigen::Vector3f b = a + 0.3F * place();
    Eigen::Vector3f c = a + 0.3F * place();
    if (i % 5 == 1) b = c = a;
    if (i % 5 == 2) c = a + 0.5F * (b - a);
    if (i % 5 == 3) c = b + 1e-5F * place();
    for (const Eigen::Vector3f& corner : {a, b, c}) mesh.vertices.push_back({.position = scale * corner + offset});
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Largest difference between SurfaceDistance and the reference over every triangle, in units of scale.
double largest_difference(const Mesh& mesh, double scale, const Vector3d& offset) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-2, 2);
  std::vector<Vector3d> points;
  for (int i = 0; i < 500; ++i)
    points.push_back(scale * Vector3d(uniform(random), uniform(random), uniform(random)) + offset);
  points.push_back(mesh.vertices[0].position.cast<double>());
  points.push_back(scale * Vector3d(1e4, -1e4, 1e4) + offset);
  const std::vector<double> distances = SurfaceDistance::build(mesh).value().to(points);

  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double reference = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles)
      reference = std::min(reference, reference_distance(points[i], {mesh.vertices[a].position.cast<double>(),
                                                                     mesh.vertices[b].position.cast<double>(),
                                                                     mesh.vertices[c].position.cast<double>()}));
    EXPECT_NEAR(distances[i], reference, 1e-12 * std::max(scale, reference)) << "point " << i;
    largest = std::max(largest, std::abs(distances[i] - reference) / scale);
  }
  return largest;
}

TEST(DistanceToTriangle, EachRegionIsMeasuredToItsNearestPlace) {
  const Vector3d a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 1, 2}, a, b, c), 2);      // above the inside
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 1, 0}, a, b, c), 0);      // on it
  EXPECT_DOUBLE_EQ(distance_to_triangle({2, -3, 4}, a, b, c), 5);     // beside an edge
  EXPECT_DOUBLE_EQ(distance_to_triangle({-3, -4, 12}, a, b, c), 13);  // beyond a corner
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 1, -2}, a, c, b), 2);     // either orientation
}

TEST(DistanceToTriangle, FlatTrianglesAreSegmentsAndPoints) {
  const Vector3d a(1, 0, 0), b(5, 0, 0);
  EXPECT_DOUBLE_EQ(distance_to_triangle({3, 4, 0}, a, b, {2, 0, 0}), 4);
  EXPECT_DOUBLE_EQ(distance_to_triangle({3, 4, 0}, a, {2, 0, 0}, b), 4);
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 0, 7}, a, a, a), 7);
}

TEST(SurfaceDistance, AgreesWithEveryTriangleMeasuredInLongDouble) {
  EXPECT_GT(largest_difference(random_triangles(300, 1, {0, 0, 0}), 1, {0, 0, 0}), 0) << "compared with itself";
}

TEST(SurfaceDistance, UnitAndPlaceOfTheSceneDoNotMatter) {
  largest_difference(random_triangles(100, 1e-6F, {0, 0, 0}), 1e-6, {0, 0, 0});
  largest_difference(random_triangles(100, 1e6F, {0, 0, 0}), 1e6, {0, 0, 0});
  largest_difference(random_triangles(100, 1e20F, {0, 0, 0}), 1e20, {0, 0, 0});  // more than Embree takes
  largest_difference(random_triangles(100, 1, {4000, -2000, 8000}), 1, {4000, -2000, 8000});
}

/// Compares with every point of a random cloud. reach: how far the points measured from lie, in half widths of the
/// cloud.
void expect_nearest_points_found(double reach) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto place = [&] { return Eigen::Vector3f(uniform(random), uniform(random), uniform(random)); };
  std::vector<Eigen::Vector3f> positions(1000);
  for (Eigen::Vector3f& position : positions) position = place();
  const Mesh cloud = cloud_of(positions);
  const SurfaceDistance distance = SurfaceDistance::build(cloud).value();
  for (int i = 0; i < 500; ++i) {
    const Vector3d point = reach * place().cast<double>();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3f& position : positions)
      nearest = std::min(nearest, (position.cast<double>() - point).norm());
    ASSERT_DOUBLE_EQ(distance(point), nearest) << i;
  }
}

TEST(SurfaceDistance, IsThatToTheNearestPointOfACloud) { expect_nearest_points_found(1); }

TEST(SurfaceDistance, IsRightFromSoFarThatFloatsAreTooCoarse) { expect_nearest_points_found(1e5); }

/// Points in a row along x, one place of a float apart, that are to be told apart; and one that sets the extent.
void expect_neighbors_told_apart(float first, float other_end) {
  std::vector<Eigen::Vector3f> positions = {{other_end, 0, 0}};
  for (float x = first; positions.size() < 500; x = std::nextafter(x, 2 * first)) positions.push_back({x, 0, 0});
  const Mesh cloud = cloud_of(positions);
  const SurfaceDistance distance = SurfaceDistance::build(cloud).value();
  for (std::size_t i = 1; i + 1 < positions.size(); ++i) {
    const double here = positions[i].x();
    const double step = positions[i + 1].x() - here;
    ASSERT_NEAR(distance({here + 0.25 * step, 0, 0}), 0.25 * step, 1e-9 * step) << i;
    ASSERT_NEAR(distance({here + 0.75 * step, 0, 0}), 0.25 * step, 1e-9 * step) << i;
  }
}

TEST(SurfaceDistance, PlacesOneFloatApartAreToldApart) {
  expect_neighbors_told_apart(8192, 8193);   // a small scene far from the origin
  expect_neighbors_told_apart(1e6F, -1e6F);  // a large scene
  expect_neighbors_told_apart(1e-6F, -1e-6F);
}

TEST(SurfaceDistance, ACornerThatIsFarOffCostsNoSearchOfEveryTriangle) {
  // 50,000 triangles and 20,000 points: all pairs would take minutes.
  Mesh mesh = random_triangles(50'000, 1, {0, 0, 0});
  for (const float far : {1e4F, 1e8F, 1e20F, -1e37F}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Eigen::Vector3f& corner : {Eigen::Vector3f(far, 0, 0), {0, 3, 0}, {0, 3, 1}})
      mesh.vertices.push_back({.position = corner});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vector3d> points;
  for (const double reach : {1.0, 1e6, 1e20, 1e37})
    for (int i = 0; i < 5000; ++i)
      points.push_back(reach * Vector3d(uniform(random), uniform(random), uniform(random)));
  const std::vector<double> distances = SurfaceDistance::build(mesh).value().to(points);
  for (std::size_t i = 0; i < points.size(); i += 500) {
    double reference = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles)
      reference = std::min(reference, reference_distance(points[i], {mesh.vertices[a].position.cast<double>(),
                                                                     mesh.vertices[b].position.cast<double>(),
                                                                     mesh.vertices[c].position.cast<double>()}));
    EXPECT_NEAR(distances[i], reference, i < 5000 ? 1e-9 : 1e-4 * reference) << i;
  }
}

TEST(SurfaceDistance, OnePointIsEnough) {
  const Mesh cloud = cloud_of({{1, 2, 3}});
  EXPECT_DOUBLE_EQ(SurfaceDistance::build(cloud).value()({1, 2, 8}), 5);
}

TEST(SurfaceDistance, NoPointsHaveNoDistances) {
  const Mesh cloud = cloud_of({{1, 2, 3}});
  EXPECT_TRUE(SurfaceDistance::build(cloud).value().to({}).empty());
}

TEST(SurfaceDistance, EmptyAndNotFiniteSurfacesAreReported) {
  const auto empty = SurfaceDistance::build(Mesh{});
  ASSERT_FALSE(empty.has_value());
  EXPECT_EQ(empty.error().kind, ErrorKind::kInput);
  EXPECT_NE(empty.error().message.find("empty"), std::string::npos);
  const Mesh holed = cloud_of({{0, 0, 0}, {0, std::numeric_limits<float>::quiet_NaN(), 0}});
  const auto not_finite = SurfaceDistance::build(holed);
  ASSERT_FALSE(not_finite.has_value());
  EXPECT_NE(not_finite.error().message.find("vertex 1 of 2"), std::string::npos) << not_finite.error().message;
}

}  // namespace
}  // namespace quorum
