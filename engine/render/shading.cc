#include "engine/render/shading.h"

#include <algorithm>

namespace quorum {
namespace {

constexpr float kSurface = 240;  ///< in each channel, where it is fully lit

Color lit_surface(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_camera) {
  const Eigen::Vector3f to_side_light = Eigen::Vector3f(-0.7F, -0.6F, -0.4F).normalized();
  constexpr float kAmbient = 0.15F;
  constexpr float kCamera = 0.55F;
  constexpr float kSide = 0.3F;
  return Color::Constant(kSurface * (kAmbient + kCamera * std::max(0.0F, normal.dot(to_camera)) +
                                     kSide * std::max(0.0F, normal.dot(to_side_light))));
}

/// share: 0 dark red, 0.5 orange, 1 yellow; each channel rises or stays.
Color confidence_color(float share) {
  const float s = std::clamp(share, 0.0F, 1.0F);
  return {70 + 185 * std::min(1.0F, 2 * s), 225 * s, 20 + 60 * s};
}

Color front_color(const SurfaceSample& sample, const Eigen::Vector3f& to_camera, const RenderOptions& options) {
  switch (options.shading) {
    case RenderOptions::Shading::kColor:
      return sample.color;
    case RenderOptions::Shading::kConfidence:
      return confidence_color(sample.confidence / options.full_confidence);
    case RenderOptions::Shading::kNormal:
      return (Color(sample.normal.x(), -sample.normal.y(), -sample.normal.z()).array() + 1.0F) * 127.5F;
    case RenderOptions::Shading::kShaded:
      break;
  }
  return lit_surface(sample.normal, to_camera);
}

}  // namespace

Color vertex_color(const Vertex& vertex) {
  return {static_cast<float>(red_of(vertex.color)), static_cast<float>(green_of(vertex.color)),
          static_cast<float>(blue_of(vertex.color))};
}

Color shade(const SurfaceSample& sample, const Eigen::Vector3f& to_camera, const RenderOptions& options) {
  const Color color = front_color(sample, to_camera, options);
  return sample.is_back ? Color(color.cwiseProduct(Color(0.45F, 0.6F, 1.0F))) : color;
}

Rgba to_pixel(const Color& color) {
  // max comes first: it turns a value that is no number, from a file's normals say, into 0.
  const auto byte = [](float value) {
    return static_cast<std::uint32_t>(std::min(255.0F, std::max(0.0F, value + 0.5F)));
  };
  return make_rgb(byte(color[0]), byte(color[1]), byte(color[2]));
}

RenderOptions settle(const RenderOptions& options, const Mesh& mesh) {
  RenderOptions settled = options;
  if (settled.full_confidence > 0) return settled;
  for (const Vertex& vertex : mesh.vertices)
    settled.full_confidence = std::max(settled.full_confidence, vertex.confidence);
  if (settled.full_confidence == 0) settled.full_confidence = 1;
  return settled;
}

}  // namespace quorum
