#include "engine/evaluate/distance.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/check.h"

namespace quorum {
namespace {

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

double squared_distance_to_segment(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared_length = along.squaredNorm();
  const double t = squared_length > 0 ? std::clamp((point - a).dot(along) / squared_length, 0.0, 1.0) : 0.0;
  return (point - a - t * along).squaredNorm();
}

double squared_distance_to_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  // The edges alone are right for points beside the triangle, and for slivers: below this ratio of height to length the
  // inside differs from the edges by less than doubles resolve, but its normal may point anywhere.
  constexpr double kSliver = 1e-12;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d bc = c - b;
  const Eigen::Vector3d ca = a - c;
  const Eigen::Vector3d normal = ab.cross(-ca);
  const double longest = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  const Eigen::Vector3d from_a = point - a;
  const bool above_inside = normal.norm() > kSliver * longest && normal.cross(ab).dot(from_a) >= 0 &&
                            normal.cross(bc).dot(point - b) >= 0 && normal.cross(ca).dot(from_a) >= 0;
  if (above_inside) {
    const double height = normal.dot(from_a);
    return height * height / normal.squaredNorm();
  }
  return std::min({squared_distance_to_segment(point, a, b), squared_distance_to_segment(point, b, c),
                   squared_distance_to_segment(point, c, a)});
}

}  // namespace

/// The search tree holds boxes in coordinates of about -0.5 to 0.5, whatever the unit and place of the surface.
struct SurfaceDistance::Tree {
  /// What one query carries through the tree.
  struct Search {
    const Tree& tree;
    Eigen::Vector3d point;
    double squared_distance = std::numeric_limits<double>::infinity();
  };

  const Mesh* surface = nullptr;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;  ///< tree units per scene unit
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene;

  [[nodiscard]] Eigen::Vector3d vertex(std::size_t index) const {
    return surface->vertices[index].position.cast<double>();
  }

  [[nodiscard]] Eigen::Vector3d to_tree(const Eigen::Vector3d& point) const { return (point - center) * scale; }

  [[nodiscard]] double squared_distance(const Eigen::Vector3d& point, unsigned primitive) const {
    if (surface->triangles.empty()) return (point - vertex(primitive)).squaredNorm();
    const auto& [a, b, c] = surface->triangles[primitive];
    return squared_distance_to_triangle(point, vertex(a), vertex(b), vertex(c));
  }

  /// Radius within which Embree must look so that it can't miss a closer primitive: the margin exceeds its rounding of
  /// the query, the boxes and the distances between them.
  [[nodiscard]] float search_radius(double distance) const {
    constexpr double kMargin = 1e-6;
    return static_cast<float>(distance * scale * (1 + kMargin) + kMargin);
  }

  static void bound_primitive(const RTCBoundsFunctionArguments* arguments);
  static bool visit_primitive(RTCPointQueryFunctionArguments* arguments);
};

namespace {

Error embree_error(RTCError code, std::size_t primitives) {
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    return {ErrorKind::kMemory,
            fmt::format("no memory for a search tree of {} triangles or points; evaluate parts of them", primitives)};
  return {ErrorKind::kDevice, "Embree can't build a search tree on this machine; it needs a CPU with SSE2"};
}

}  // namespace

void SurfaceDistance::Tree::bound_primitive(const RTCBoundsFunctionArguments* arguments) {
  const Tree& tree = *static_cast<const Tree*>(arguments->geometryUserPtr);
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  if (tree.surface->triangles.empty()) {
    low = high = tree.to_tree(tree.vertex(arguments->primID));
  } else {
    const auto& [a, b, c] = tree.surface->triangles[arguments->primID];
    low = tree.to_tree(tree.vertex(a).cwiseMin(tree.vertex(b)).cwiseMin(tree.vertex(c)));
    high = tree.to_tree(tree.vertex(a).cwiseMax(tree.vertex(b)).cwiseMax(tree.vertex(c)));
  }
  constexpr float kFarthest = std::numeric_limits<float>::max();
  const auto down = [](double value) { return std::nextafter(static_cast<float>(value), -kFarthest); };
  const auto up = [](double value) { return std::nextafter(static_cast<float>(value), kFarthest); };
  *arguments->bounds_o = {down(low.x()), down(low.y()), down(low.z()), 0, up(high.x()), up(high.y()), up(high.z()), 0};
}

bool SurfaceDistance::Tree::visit_primitive(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  const double squared_distance = search.tree.squared_distance(search.point, arguments->primID);
  if (!(squared_distance < search.squared_distance)) return false;
  search.squared_distance = squared_distance;
  arguments->query->radius = search.tree.search_radius(std::sqrt(squared_distance));
  return true;
}

Expected<void> check_surface(const Mesh& surface) {
  if (surface.vertices.empty())
    return failure(ErrorKind::kInput, "the surface is empty; give a mesh or a cloud with at least one vertex");
  for (std::size_t i = 0; i < surface.vertices.size(); ++i)
    if (!surface.vertices[i].position.allFinite())
      return failure(ErrorKind::kInput, fmt::format("vertex {} of {} has a position that is not finite; remove it", i,
                                                    surface.vertices.size()));
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t corner : triangle) QUORUM_CHECK_LT(corner, surface.vertices.size());
  return {};
}

double distance_to_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
  return std::sqrt(squared_distance_to_triangle(point, a, b, c));
}

Expected<SurfaceDistance> SurfaceDistance::build(const Mesh& surface) {
  if (auto checked = check_surface(surface); !checked) return std::unexpected(checked.error());
  const std::size_t primitives = surface.triangles.empty() ? surface.vertices.size() : surface.triangles.size();
  if (primitives >= RTC_INVALID_GEOMETRY_ID)
    return failure(ErrorKind::kMemory, fmt::format("{} triangles or points; at most 2^32 - 2 can be searched, evaluate "
                                                   "parts of them",
                                                   primitives));

  auto tree = std::make_shared<Tree>();
  tree->surface = &surface;
  Eigen::Vector3d low = tree->vertex(0);
  Eigen::Vector3d high = low;
  for (const Vertex& vertex : surface.vertices) {
    low = low.cwiseMin(vertex.position.cast<double>());
    high = high.cwiseMax(vertex.position.cast<double>());
  }
  const double extent = (high - low).maxCoeff();
  tree->center = (low + high) / 2;
  tree->scale = extent > 0 ? 1 / extent : 1;

  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), &rtcReleaseDevice);
  if (!device) return std::unexpected(embree_error(rtcGetDeviceError(nullptr), primitives));
  tree->scene.reset(rtcNewScene(device.get()));
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(primitives));
  rtcSetGeometryUserData(geometry, tree.get());
  rtcSetGeometryBoundsFunction(geometry, &Tree::bound_primitive, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree->scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree->scene.get());
  if (const RTCError code = rtcGetDeviceError(device.get()); code != RTC_ERROR_NONE)
    return std::unexpected(embree_error(code, primitives));
  return SurfaceDistance(std::move(tree));
}

double SurfaceDistance::operator()(const Eigen::Vector3d& point) const {
  Tree::Search search{*tree_, point};
  const Eigen::Vector3f place = tree_->to_tree(point).cast<float>();
  RTCPointQuery query{place.x(), place.y(), place.z(), 0.0F, std::numeric_limits<float>::infinity()};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(tree_->scene.get(), &query, &context, &Tree::visit_primitive, &search);
  return std::sqrt(search.squared_distance);
}

std::vector<double> SurfaceDistance::to(std::span<const Eigen::Vector3d> points) const {
  std::vector<double> distances(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) distances[i] = (*this)(points[i]);
  });
  return distances;
}

}  // namespace quorum
