#include "engine/evaluate/seen_by.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "engine/evaluate/distance.h"

namespace quorum {

/// Coordinates of about -0.5 to 0.5, whatever their unit and place.
struct Sight::Tree {
  struct Release {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<RTCSceneTy, Release> scene;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;  ///< tree units per scene unit

  [[nodiscard]] Eigen::Vector3f to_tree(const Eigen::Vector3d& point) const {
    return ((point - center) * scale).cast<float>();
  }

  /// Sets center and scale so that the surface fits.
  void fit(const Mesh& surface) {
    Eigen::Vector3d low = surface.vertices[0].position.cast<double>();
    Eigen::Vector3d high = low;
    for (const Vertex& vertex : surface.vertices) {
      low = low.cwiseMin(vertex.position.cast<double>());
      high = high.cwiseMax(vertex.position.cast<double>());
    }
    center = (low + high) / 2;
    const double extent = (high - low).maxCoeff();
    scale = extent > 0 ? 1 / extent : 1;
  }
};

Expected<Sight> Sight::build(const Mesh& surface) {
  QUORUM_TRY(check_surface(surface));
  if (surface.triangles.empty())
    return failure(ErrorKind::kInput, "a cloud hides nothing; give the true surface as triangles");
  const auto failed = [&](RTCError code) {
    if (code == RTC_ERROR_OUT_OF_MEMORY)
      return failure(ErrorKind::kMemory, fmt::format("no memory for the lines of sight past {} triangles; give a "
                                                     "coarser surface",
                                                     surface.triangles.size()));
    return failure(ErrorKind::kDevice, "Embree can't work on this machine; it needs a CPU with SSE2");
  };
  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), &rtcReleaseDevice);
  if (!device) return failed(rtcGetDeviceError(nullptr));
  auto tree = std::make_shared<Tree>();
  tree->fit(surface);
  tree->scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(tree->scene.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips through between two triangles
  const std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)> geometry(
      rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE), &rtcReleaseGeometry);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), surface.vertices.size()));
  auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), surface.triangles.size()));
  if (positions == nullptr || corners == nullptr) return failed(RTC_ERROR_OUT_OF_MEMORY);
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    Eigen::Map<Eigen::Vector3f>(positions + 3 * v) = tree->to_tree(surface.vertices[v].position.cast<double>());
  for (const auto& triangle : surface.triangles) corners = std::ranges::copy(triangle, corners).out;
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(tree->scene.get(), geometry.get());
  rtcCommitScene(tree->scene.get());
  if (const RTCError code = rtcGetDeviceError(device.get()); code != RTC_ERROR_NONE) return failed(code);
  Sight sight;
  sight.tree_ = std::move(tree);
  return sight;
}

bool Sight::sees(const View& view, const Eigen::Vector3d& point, double margin) const {
  const Eigen::Vector3d pixel = view.camera.project(point);
  const bool inside =
      pixel.z() > 0 && pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= view.width - 1 && pixel.y() <= view.height - 1;
  if (!inside) return false;
  const Eigen::Vector3d to_camera = view.camera.center() - point;
  const double distance = to_camera.norm();
  if (distance <= margin) return true;
  const Eigen::Vector3f start = tree_->to_tree(point + to_camera * (margin / distance));
  const Eigen::Vector3f direction = (to_camera / distance).cast<float>();
  RTCRay ray{};
  ray.org_x = start.x();
  ray.org_y = start.y();
  ray.org_z = start.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = static_cast<float>((distance - margin) * tree_->scale);
  ray.mask = std::numeric_limits<unsigned>::max();
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(tree_->scene.get(), &context, &ray);
  return ray.tfar >= 0;
}

std::vector<int> Sight::views_that_see(const std::vector<View>& views, std::span<const Eigen::Vector3d> points,
                                       double margin) const {
  std::vector<int> counts(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      counts[i] = static_cast<int>(
          std::ranges::count_if(views, [&](const View& view) { return sees(view, points[i], margin); }));
  });
  return counts;
}

}  // namespace quorum
