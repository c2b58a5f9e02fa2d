#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include "engine/synthetic/temple.h"
#include "engine/synthetic/temple_solids.h"

namespace quorum {
namespace {

using Eigen::Vector3d;

constexpr double kMaxEdge = 1e-3;

const Mesh& surface() {
  static const Mesh kSurface = temple_surface(kMaxEdge);
  return kSurface;
}

std::array<Vector3d, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
  std::array<Vector3d, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh.vertices[mesh.triangles[triangle][i]].position.cast<double>();
  return corners;
}

/// Twice the area, along the outward normal.
Vector3d cross_of(const std::array<Vector3d, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) area += cross_of(corners_of(mesh, i)).norm() / 2;
  return area;
}

double disk_area(double radius) { return std::numbers::pi * radius * radius; }

double area_of(const Solid& solid) {
  const Vector3d size = bounds_of(solid).size();
  if (const auto* drum = std::get_if<Drum>(&solid)) {
    const double slant = std::hypot(drum->height, drum->foot_radius - drum->head_radius);
    return disk_area(drum->foot_radius) + disk_area(drum->head_radius) +
           std::numbers::pi * (drum->foot_radius + drum->head_radius) * slant;
  }
  if (std::holds_alternative<Gable>(solid))
    return size.x() * size.z() + size.x() * size.y() + 2 * size.z() * std::hypot(size.x() / 2, size.y());
  return 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

/// Area in which the high side of a lies on the low side of b, across an axis. Drums stand wholly on what bears them.
double contact_area(const Solid& a, const Solid& b, int axis) {
  const Bounds low = bounds_of(a);
  const Bounds high = bounds_of(b);
  if (std::abs(low.high[axis] - high.low[axis]) > 1e-9) return 0;
  const Vector3d overlap = low.high.cwiseMin(high.high) - low.low.cwiseMax(high.low);
  double rectangle = 1;
  for (int other = 0; other < 3; ++other)
    if (other != axis) rectangle *= std::max(0.0, overlap[other]);
  if (rectangle < 1e-12) return 0;
  const auto* lower = std::get_if<Drum>(&a);
  const auto* upper = std::get_if<Drum>(&b);
  if (lower == nullptr && upper == nullptr) return rectangle;
  const double radius =
      std::min(lower != nullptr ? lower->head_radius : 1.0, upper != nullptr ? upper->foot_radius : 1.0);
  return disk_area(radius);
}

double exposed_area() {
  double area = 0;
  for (const Solid& solid : temple_solids()) {
    area += area_of(solid);
    const Bounds bounds = bounds_of(solid);
    if (bounds.low.y() == 0) area -= bounds.size().x() * bounds.size().z();
    for (const Solid& other : temple_solids())
      for (int axis = 0; axis < 3; ++axis) area -= 2 * contact_area(solid, other, axis);
  }
  return area;
}

double distance_to_segment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d edge = b - a;
  const double share = std::clamp(edge.dot(point - a) / edge.squaredNorm(), 0.0, 1.0);
  return (point - a - share * edge).norm();
}

double distance_to_triangle(const Vector3d& point, const std::array<Vector3d, 3>& t) {
  const Vector3d normal = cross_of(t).normalized();
  bool above = true;
  double distance = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& from = t[i];
    const Vector3d& to = t[(i + 1) % 3];
    above = above && normal.dot((to - from).cross(point - from)) >= 0;
    distance = std::min(distance, distance_to_segment(point, from, to));
  }
  return above ? std::abs(normal.dot(point - t[0])) : distance;
}

/// Triangles by the cell of their centroid, for looking up what lies near a point.
class NearbyTriangles {
 public:
  explicit NearbyTriangles(const Mesh& mesh) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto t = corners_of(mesh, i);
      cells_[cell_of((t[0] + t[1] + t[2]) / 3)].push_back(i);
    }
  }
  [[nodiscard]] double distance(const Vector3d& point) const {
    const Cell middle = cell_of(point);
    double nearest = 1;
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
      if (found == cells_.end()) continue;
      for (const std::size_t triangle : found->second)
        nearest = std::min(nearest, distance_to_triangle(point, corners_of(mesh_, triangle)));
    }
    return nearest;
  }

 private:
  using Cell = std::array<int, 3>;
  static Cell cell_of(const Vector3d& point) {
    const Vector3d cell = (point / kMaxEdge).array().floor();
    return {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())};
  }
  const Mesh& mesh_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

TEST(TempleSolids, TouchButNeverReachIntoOneAnother) {
  const auto solids = temple_solids();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Bounds a = bounds_of(solids[i]);
      const Bounds b = bounds_of(solids[j]);
      const double overlap = (a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low)).minCoeff();
      EXPECT_LT(overlap, 1e-9) << "solids " << i << " and " << j;
    }
  }
}

TEST(TempleSolids, MirroredTempleIsAnother) {
  const auto inside = [](const Vector3d& point) {
    return std::ranges::any_of(temple_solids(), [&](const Solid& solid) { return contains(solid, point, 0); });
  };
  const Vector3d in_buttress(0.037, 0.040, -0.018);
  EXPECT_TRUE(inside(in_buttress));
  EXPECT_FALSE(inside(in_buttress.cwiseProduct(Vector3d(-1, 1, 1))));
  EXPECT_FALSE(inside(in_buttress.cwiseProduct(Vector3d(1, 1, -1))));
  EXPECT_FALSE(inside(in_buttress.cwiseProduct(Vector3d(-1, 1, -1))));
}

TEST(TempleSurface, EdgesKeepTheirLimitAndNoTriangleIsFlat) {
  for (const double max_edge : {kMaxEdge, 7e-3}) {
    const Mesh mesh = temple_surface(max_edge);
    double longest = 0;
    double smallest_area = 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto t = corners_of(mesh, i);
      longest = std::max({longest, (t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
      smallest_area = std::min(smallest_area, cross_of(t).norm() / 2);
    }
    EXPECT_LE(longest, max_edge);
    EXPECT_GT(longest, 0.9 * max_edge);
    EXPECT_GT(smallest_area, 1e-10);
  }
}

TEST(TempleSurface, NormalsAreUnitAndAgreeWithTheWinding) {
  for (std::size_t i = 0; i < surface().triangles.size(); ++i) {
    const Vector3d normal = cross_of(corners_of(surface(), i)).normalized();
    for (const std::uint32_t corner : surface().triangles[i]) {
      const Vector3d of_vertex = surface().vertices[corner].normal.cast<double>();
      ASSERT_NEAR(of_vertex.norm(), 1, 1e-6);
      ASSERT_GT(of_vertex.dot(normal), 0.99) << "triangle " << i;
    }
  }
}

TEST(TempleSurface, VerticesLieOnTheSurfaceAndInNoSolid) {
  for (const Vertex& vertex : surface().vertices) {
    const Vector3d position = vertex.position.cast<double>();
    const Vector3d outside = position + 1e-6 * vertex.normal.cast<double>();
    bool on_surface = false;
    for (const Solid& solid : temple_solids()) {
      ASSERT_FALSE(contains(solid, position, -1e-6)) << position.transpose();
      on_surface = on_surface || (contains(solid, position, 1e-7) && !contains(solid, outside, 1e-7));
    }
    ASSERT_TRUE(on_surface) << position.transpose();
  }
}

TEST(TempleSurface, LongEdgesStayCloseToRoundFaces) {
  const Mesh mesh = temple_surface(7e-3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto t = corners_of(mesh, i);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3d middle = (t[corner] + t[(corner + 1) % 3]) / 2;
      EXPECT_TRUE(std::ranges::any_of(temple_solids(), [&](const Solid& solid) {
        return contains(solid, middle, 1e-7) && !contains(solid, middle, -1.1e-5);
      })) << middle.transpose();
    }
  }
}

TEST(TempleSurface, AreaIsThatOfThePartsLessTheirContacts) {
  const double expected = exposed_area();
  EXPECT_GT(expected, 0.05);
  // Triangles that a column foot covers in part stay, so the mesh is larger by a seam around each.
  const double coarse = area_of(surface());
  const double fine = area_of(temple_surface(kMaxEdge / 2));
  EXPECT_GT(coarse, expected * 0.9995);
  EXPECT_LT(coarse, expected * 1.005);
  EXPECT_LT(std::abs(fine - expected), std::abs(coarse - expected));
}

TEST(TempleSurface, ExtentIsThatOfTheBounds) {
  const Bounds bounds = make_temple_scene({}).bounds;
  Bounds extent{Vector3d::Constant(1), Vector3d::Constant(-1)};
  for (const Vertex& vertex : surface().vertices) {
    extent.low = extent.low.cwiseMin(vertex.position.cast<double>());
    extent.high = extent.high.cwiseMax(vertex.position.cast<double>());
  }
  EXPECT_LT((extent.low - bounds.low).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((extent.high - bounds.high).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(TempleSurface, NothingLiesOnTheGround) {
  for (std::size_t i = 0; i < surface().triangles.size(); ++i) {
    const auto t = corners_of(surface(), i);
    EXPECT_GT(std::max({t[0].y(), t[1].y(), t[2].y()}), 0);
  }
}

TEST(TempleSurface, RaysThatSeeTheSolidsEndOnTheMesh) {
  const NearbyTriangles nearby(surface());
  TempleOptions options;
  options.views = 5;
  int hits = 0;
  for (const CameraPath path : {CameraPath::kRing, CameraPath::kHemisphere}) {
    options.path = path;
    for (const View& view : make_temple_scene(options).views) {
      for (int y = 3; y < view.height; y += 11) {
        for (int x = 3; x < view.width; x += 11) {
          const Ray ray{view.camera.center(), view.camera.unproject(x, y, 1.0) - view.camera.center()};
          double nearest = 0;
          for (const Solid& solid : temple_solids())
            if (const auto hit = intersect(solid, ray)) nearest = nearest > 0 ? std::min(nearest, hit->t) : hit->t;
          if (nearest == 0) continue;
          ++hits;
          ASSERT_LT(nearby.distance(ray.origin + nearest * ray.direction), 2e-5) << "pixel " << x << ", " << y;
        }
      }
    }
  }
  EXPECT_GT(hits, 2000);
}

}  // namespace
}  // namespace quorum
