#include "engine/evaluate/distance.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

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

/// A search tree over primitives that lie together. It holds boxes in coordinates of about -0.5 to 0.5, whatever their
/// unit and place.
struct SurfaceDistance::Tree {
  /// What one query carries through the trees.
  struct Search {
    const Tree* tree = nullptr;
    Eigen::Vector3d point;
    double squared_distance = std::numeric_limits<double>::infinity();
  };

  const Mesh* surface = nullptr;
  std::vector<std::uint32_t> primitives;  ///< triangles, or vertices where there are none
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;  ///< tree units per scene unit
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene;

  [[nodiscard]] Eigen::Vector3d vertex(std::size_t index) const {
    return surface->vertices[index].position.cast<double>();
  }

  [[nodiscard]] Eigen::Vector3d to_tree(const Eigen::Vector3d& point) const { return (point - center) * scale; }

  /// The corners of a primitive: one point three times in a cloud.
  [[nodiscard]] std::array<Eigen::Vector3d, 3> corners(std::uint32_t primitive) const {
    if (surface->triangles.empty()) return {vertex(primitive), vertex(primitive), vertex(primitive)};
    const auto& [a, b, c] = surface->triangles[primitive];
    return {vertex(a), vertex(b), vertex(c)};
  }

  [[nodiscard]] double squared_distance(const Eigen::Vector3d& point, std::uint32_t primitive) const {
    if (surface->triangles.empty()) return (point - vertex(primitive)).squaredNorm();
    const auto& [a, b, c] = corners(primitive);
    return squared_distance_to_triangle(point, a, b, c);
  }

  /// To the box of all primitives.
  [[nodiscard]] double squared_distance_to_box(const Eigen::Vector3d& point) const {
    return (point - point.cwiseMax(low).cwiseMin(high)).squaredNorm();
  }

  /// Radius within which Embree must look so that it can't miss a closer primitive: the margin exceeds its rounding of
  /// the query, the boxes and the distances between them.
  [[nodiscard]] float search_radius(double distance) const {
    constexpr double kMargin = 1e-6;
    return static_cast<float>(distance * scale * (1 + kMargin) + kMargin);
  }

  /// Takes those of the primitives that lie together, at least half, and leaves the others.
  static std::unique_ptr<Tree> take_cluster(const Mesh& surface, std::vector<std::uint32_t>& primitives);
  Expected<void> build();
  void look_for_closer(Search& search) const;

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
  const auto& [a, b, c] = tree.corners(tree.primitives[arguments->primID]);
  const Eigen::Vector3d low = tree.to_tree(a.cwiseMin(b).cwiseMin(c));
  const Eigen::Vector3d high = tree.to_tree(a.cwiseMax(b).cwiseMax(c));
  constexpr float kFarthest = std::numeric_limits<float>::max();
  const auto down = [](double value) { return std::nextafter(static_cast<float>(value), -kFarthest); };
  const auto up = [](double value) { return std::nextafter(static_cast<float>(value), kFarthest); };
  *arguments->bounds_o = {down(low.x()), down(low.y()), down(low.z()), 0, up(high.x()), up(high.y()), up(high.z()), 0};
}

bool SurfaceDistance::Tree::visit_primitive(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  const double squared_distance =
      search.tree->squared_distance(search.point, search.tree->primitives[arguments->primID]);
  if (!(squared_distance < search.squared_distance)) return false;
  search.squared_distance = squared_distance;
  arguments->query->radius = search.tree->search_radius(std::sqrt(squared_distance));
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

// A corner that is far off would make a point of all others in a tree of all primitives, so that each query would look
// at each of them.
std::unique_ptr<SurfaceDistance::Tree> SurfaceDistance::Tree::take_cluster(const Mesh& surface,
                                                                           std::vector<std::uint32_t>& primitives) {
  constexpr double kFar = 1e4;  // times the median distance from the middle
  auto tree = std::make_unique<Tree>();
  tree->surface = &surface;
  const std::size_t half = (primitives.size() - 1) / 2;
  std::vector<double> values(primitives.size());
  const auto median = [&values, half] {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(half));
    return values[half];
  };
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(primitives, values.begin(),
                           [&](std::uint32_t primitive) { return tree->corners(primitive)[0][axis]; });
    middle[axis] = median();
  }
  const auto distance = [&](std::uint32_t primitive) {
    double most = 0.0;
    for (const Eigen::Vector3d& corner : tree->corners(primitive))
      most = std::max(most, (corner - middle).cwiseAbs().maxCoeff());
    return most;
  };
  std::ranges::transform(primitives, values.begin(), distance);
  const double far = kFar * median();
  const auto others = std::stable_partition(primitives.begin(), primitives.end(),
                                            [&](std::uint32_t primitive) { return distance(primitive) <= far; });
  tree->primitives.assign(primitives.begin(), others);
  primitives.erase(primitives.begin(), others);
  return tree;
}

Expected<void> SurfaceDistance::Tree::build() {
  low.setConstant(std::numeric_limits<double>::infinity());
  high = -low;
  for (const std::uint32_t primitive : primitives)
    for (const Eigen::Vector3d& corner : corners(primitive)) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  const double extent = (high - low).maxCoeff();
  center = (low + high) / 2;
  scale = extent > 0 ? 1 / extent : 1;

  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), &rtcReleaseDevice);
  if (!device) return std::unexpected(embree_error(rtcGetDeviceError(nullptr), primitives.size()));
  scene.reset(rtcNewScene(device.get()));
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(primitives.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, &Tree::bound_primitive, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (const RTCError code = rtcGetDeviceError(device.get()); code != RTC_ERROR_NONE)
    return std::unexpected(embree_error(code, primitives.size()));
  return {};
}

void SurfaceDistance::Tree::look_for_closer(Search& search) const {
  constexpr double kFar = 1e5;  // times the size of the box: single precision tells no primitive from another there
  const double to_box = squared_distance_to_box(search.point);
  if (to_box >= search.squared_distance) return;
  if (to_box > kFar * kFar * (high - low).squaredNorm()) {
    search.squared_distance = to_box;
    return;
  }
  search.tree = this;
  const Eigen::Vector3f place = to_tree(search.point).cast<float>();
  RTCPointQuery query{place.x(), place.y(), place.z(), 0.0F, search_radius(std::sqrt(search.squared_distance))};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene.get(), &query, &context, &Tree::visit_primitive, &search);
}

Expected<SurfaceDistance> SurfaceDistance::build(const Mesh& surface) {
  QUORUM_TRY(check_surface(surface));
  const std::size_t count = surface.triangles.empty() ? surface.vertices.size() : surface.triangles.size();
  if (count >= RTC_INVALID_GEOMETRY_ID)
    return failure(ErrorKind::kMemory, fmt::format("{} triangles or points; at most 2^32 - 2 can be searched, evaluate "
                                                   "parts of them",
                                                   count));
  std::vector<std::uint32_t> primitives(count);
  std::iota(primitives.begin(), primitives.end(), 0U);
  SurfaceDistance distance;
  while (!primitives.empty()) {
    std::shared_ptr<Tree> tree = Tree::take_cluster(surface, primitives);
    QUORUM_TRY(tree->build());
    distance.trees_.push_back(std::move(tree));
  }
  return distance;
}

double SurfaceDistance::operator()(const Eigen::Vector3d& point) const {
  Tree::Search search{nullptr, point};
  for (const auto& tree : trees_) tree->look_for_closer(search);
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
