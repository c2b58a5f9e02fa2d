#include "engine/evaluate/primitive_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/evaluate/triangle_distance.h"

namespace quorum {
namespace {

Error embree_error(RTCError code, std::size_t primitives) {
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    return {ErrorKind::kMemory,
            fmt::format("no memory for a search tree of {} triangles or points; evaluate parts of them", primitives)};
  return {ErrorKind::kDevice, "Embree can't build a search tree on this machine; it needs a CPU with SSE2"};
}

}  // namespace

void PrimitiveTree::bound_primitive(const RTCBoundsFunctionArguments* arguments) {
  const PrimitiveTree& tree = *static_cast<const PrimitiveTree*>(arguments->geometryUserPtr);
  const auto& [a, b, c] = tree.corners(tree.primitives[arguments->primID]);
  const Eigen::Vector3d low = tree.to_tree(a.cwiseMin(b).cwiseMin(c));
  const Eigen::Vector3d high = tree.to_tree(a.cwiseMax(b).cwiseMax(c));
  constexpr float kFarthest = std::numeric_limits<float>::max();
  const auto down = [](double value) { return std::nextafter(static_cast<float>(value), -kFarthest); };
  const auto up = [](double value) { return std::nextafter(static_cast<float>(value), kFarthest); };
  *arguments->bounds_o = {down(low.x()), down(low.y()), down(low.z()), 0, up(high.x()), up(high.y()), up(high.z()), 0};
}

bool PrimitiveTree::visit_primitive(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  const double squared_distance =
      search.tree->squared_distance(search.point, search.tree->primitives[arguments->primID]);
  if (!(squared_distance < search.squared_distance)) return false;
  search.squared_distance = squared_distance;
  arguments->query->radius = search.tree->search_radius(std::sqrt(squared_distance));
  return true;
}

// A corner that is far off would make a point of all others in a tree of all primitives, so that each query would look
// at each of them.
std::unique_ptr<PrimitiveTree> PrimitiveTree::take_cluster(const Mesh& surface,
                                                           std::vector<std::uint32_t>& primitives) {
  constexpr double kFar = 1e4;  // times the median distance from the middle
  auto tree = std::make_unique<PrimitiveTree>();
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

Expected<void> PrimitiveTree::build() {
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
  rtcSetGeometryBoundsFunction(geometry, &PrimitiveTree::bound_primitive, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (const RTCError code = rtcGetDeviceError(device.get()); code != RTC_ERROR_NONE)
    return std::unexpected(embree_error(code, primitives.size()));
  return {};
}

void PrimitiveTree::look_for_closer(Search& search) const {
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
  rtcPointQuery(scene.get(), &query, &context, &PrimitiveTree::visit_primitive, &search);
}

}  // namespace quorum
