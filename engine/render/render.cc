#include "engine/render/render.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "engine/core/check.h"
#include "engine/render/shading.h"

namespace quorum {
namespace {

using EmbreeScene = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;

/// A triangle where a ray meets it, in camera axes.
struct Hit {
  std::array<const Vertex*, 3> corners;
  Eigen::Vector3f shares;  ///< of the three corners, sum 1
  Eigen::Vector3f normal;  ///< unit length, toward the side that is seen
  bool is_back = false;
  std::uint32_t triangle = 0;

  template <typename Function>
  auto blend(Function value) const -> decltype(value(*corners[0])) {
    return value(*corners[0]) * shares[0] + value(*corners[1]) * shares[1] + value(*corners[2]) * shares[2];
  }
};

/// Positions in camera axes, so that rays start at the origin, and in a unit that suits single precision.
struct ToTree {
  const Camera& camera;
  double scale = 1;  ///< tree units per scene unit

  [[nodiscard]] Eigen::Vector3f operator()(const Vertex& vertex) const {
    return (camera.to_camera(vertex.position.cast<double>()) * scale).cast<float>();
  }
};

/// Scale at which the farthest vertex has a coordinate of 1.
double scale_to_unit(const Mesh& mesh, const Camera& camera) {
  double farthest = 0;
  for (const Vertex& vertex : mesh.vertices)
    if (vertex.position.allFinite())
      farthest = std::max(farthest, camera.to_camera(vertex.position.cast<double>()).cwiseAbs().maxCoeff());
  return farthest > 0 ? 1 / farthest : 1;
}

Expected<EmbreeScene> build_scene(const Mesh& mesh, const ToTree& to_tree) {
  const auto no_memory = [&] {
    return failure(ErrorKind::kMemory,
                   fmt::format("no memory to draw {} triangles; draw a part or a coarser mesh", mesh.triangles.size()));
  };
  const auto no_device = [] {
    return failure(ErrorKind::kDevice, "Embree can't draw on this machine; it needs a CPU with SSE2");
  };
  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), &rtcReleaseDevice);
  if (!device) return no_device();

  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)> geometry_owner(geometry, &rtcReleaseGeometry);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), mesh.vertices.size()));
  if (positions == nullptr) return no_memory();
  tbb::parallel_for(std::size_t{0}, mesh.vertices.size(),
                    [&](std::size_t v) { Eigen::Map<Eigen::Vector3f>(positions + 3 * v) = to_tree(mesh.vertices[v]); });
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(mesh.triangles[0]), mesh.triangles.size());
  rtcCommitGeometry(geometry);

  EmbreeScene scene(rtcNewScene(device.get()), &rtcReleaseScene);
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no ray slips through between two triangles
  rtcAttachGeometry(scene.get(), geometry);
  rtcCommitScene(scene.get());
  switch (rtcGetDeviceError(device.get())) {
    case RTC_ERROR_NONE:
      return scene;
    case RTC_ERROR_OUT_OF_MEMORY:
      return no_memory();
    default:
      return no_device();
  }
}

Hit describe_hit(const Mesh& mesh, const ToTree& to_tree, const RTCRayHit& ray) {
  const auto& [a, b, c] = mesh.triangles[ray.hit.primID];
  Hit hit;
  hit.corners = {&mesh.vertices[a], &mesh.vertices[b], &mesh.vertices[c]};
  hit.shares = {1 - ray.hit.u - ray.hit.v, ray.hit.u, ray.hit.v};
  hit.triangle = ray.hit.primID;
  const Eigen::Vector3f origin = to_tree(*hit.corners[0]);
  const Eigen::Vector3f face =
      (to_tree(*hit.corners[1]) - origin).cross(to_tree(*hit.corners[2]) - origin).normalized();
  hit.is_back = face.dot(Eigen::Vector3f(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z)) > 0;
  const bool has_normals = std::ranges::none_of(hit.corners, [](const Vertex* v) { return v->normal.isZero(0); });
  const Eigen::Vector3f in_world = hit.blend([](const Vertex& v) { return Eigen::Vector3f(v.normal); });
  hit.normal = has_normals ? (to_tree.camera.camera_from_world.cast<float>() * in_world).normalized() : face;
  if (hit.is_back) hit.normal = -hit.normal;
  return hit;
}

/// What is drawn, and how.
struct Picture {
  RTCScene scene;
  const Mesh& mesh;
  const TexturedMesh* texture;  ///< of the same mesh, or null
  const ToTree& to_tree;
  const RenderOptions& options;
};

/// Between the centers of four pixels of a page.
Color page_color(const ColorImage& page, const Eigen::Vector2f& place) {
  const float x =
      std::clamp(place.x() * static_cast<float>(page.width) - 0.5F, 0.0F, static_cast<float>(page.width - 1));
  const float y =
      std::clamp(place.y() * static_cast<float>(page.height) - 0.5F, 0.0F, static_cast<float>(page.height - 1));
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const float right_share = x - static_cast<float>(left);
  const float lower_share = y - static_cast<float>(top);
  const auto at = [&](int column, int row) {
    const Rgba pixel = page.at(std::min(column, page.width - 1), std::min(row, page.height - 1));
    return Color(static_cast<float>(red_of(pixel)), static_cast<float>(green_of(pixel)),
                 static_cast<float>(blue_of(pixel)));
  };
  const Color upper = at(left, top) * (1 - right_share) + at(left + 1, top) * right_share;
  const Color lower = at(left, top + 1) * (1 - right_share) + at(left + 1, top + 1) * right_share;
  return upper * (1 - lower_share) + lower * lower_share;
}

Color color_at(const Picture& picture, const Hit& hit) {
  const TexturedMesh* texture = picture.texture;
  if (texture == nullptr || hit.triangle >= texture->first_triangles[texture->pages.size()])
    return hit.blend(vertex_color);
  const auto next = std::ranges::upper_bound(texture->first_triangles, hit.triangle);
  const auto page = static_cast<std::size_t>(next - texture->first_triangles.begin()) - 1;
  const auto place_of = [&](const Vertex& vertex) -> Eigen::Vector2f {
    return texture->coordinates[static_cast<std::size_t>(&vertex - texture->mesh.vertices.data())];
  };
  return page_color(texture->pages[page], hit.blend(place_of));
}

struct Trace {
  Color color = kBackground;
  bool is_outside = false;  ///< the outside of a triangle was met
};

/// What is seen along a direction from the center of projection. direction: camera axes, unit length.
Trace trace(const Picture& picture, const Eigen::Vector3f& direction) {
  RTCRayHit ray{};
  ray.ray.dir_x = direction.x();
  ray.ray.dir_y = direction.y();
  ray.ray.dir_z = direction.z();
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(picture.scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const Hit hit = describe_hit(picture.mesh, picture.to_tree, ray);
  const SurfaceSample sample{color_at(picture, hit), hit.blend([](const Vertex& v) { return v.confidence; }),
                             hit.normal, hit.is_back};
  return {shade(sample, -direction, picture.options), !hit.is_back};
}

/// whole: as render_textured has it.
Expected<ColorImage> render_both(const Mesh& mesh, const TexturedMesh* texture, const Camera& camera, int width,
                                 int height, const RenderOptions& options, Mask* whole) {
  QUORUM_CHECK_GE(width, 0);
  QUORUM_CHECK_GE(height, 0);
  QUORUM_TRY(options.check());
  ColorImage image(width, height, to_pixel(kBackground));
  if (whole != nullptr) *whole = Mask(width, height);
  if (mesh.triangles.empty()) return image;

  const RenderOptions settled = settle(options, mesh);
  const ToTree to_tree{camera, scale_to_unit(mesh, camera)};
  QUORUM_ASSIGN(const auto scene, build_scene(mesh, to_tree));
  const Picture picture{scene.get(), mesh, texture, to_tree, settled};

  const Eigen::Matrix3d ray_from_pixel = camera.intrinsics.inverse();
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      Color sum = Color::Zero();
      int hits = 0;
      for (const double dy : {-0.25, 0.25})
        for (const double dx : {-0.25, 0.25}) {
          const Eigen::Vector3d direction = (ray_from_pixel * Eigen::Vector3d(x + dx, y + dy, 1)).normalized();
          const Trace seen = trace(picture, direction.cast<float>());
          sum += seen.color;
          hits += seen.is_outside ? 1 : 0;
        }
      image.at(x, y) = to_pixel(sum / 4);
      if (whole != nullptr) whole->at(x, y) = hits == 4 ? 1 : 0;
    }
  });
  return image;
}

}  // namespace

Expected<void> RenderOptions::check() const {
  if (!(std::isfinite(full_confidence) && full_confidence >= 0))
    return failure(ErrorKind::kUsage,
                   fmt::format("full_confidence: {} is not a number of at least 0", full_confidence));
  return {};
}

Expected<ColorImage> render_mesh(const Mesh& mesh, const Camera& camera, int width, int height,
                                 const RenderOptions& options) {
  return render_both(mesh, nullptr, camera, width, height, options, nullptr);
}

Expected<ColorImage> render_textured(const TexturedMesh& mesh, const Camera& camera, int width, int height,
                                     const RenderOptions& options, Mask* whole) {
  return render_both(mesh.mesh, mesh.pages.empty() ? nullptr : &mesh, camera, width, height, options, whole);
}

}  // namespace quorum
