// Which neighboring pixels a surface joins. Where depth steps steeply, one of the two must lie on the other's plane: a
// surface at a grazing angle goes on, and a step between two surfaces does not. Twin: shaders/lib/plane_edges.glsl.
#pragma once

#include "engine/volume/cell.h"

namespace quorum {

/// A pixel of a depth map.
struct SurfacePixel {
  float x;
  float y;
  float depth;           ///< 0 = none
  std::uint32_t normal;  ///< of its plane, as pack_normals gives it
};

/// True if `other` lies within limit, scene units, of the plane of `pixel`, or if that has none.
inline bool holds(const SurfacePixel& pixel, const SurfacePixel& other, float limit, const RangeSurfaceParams& params) {
  constexpr std::uint32_t kMask = (1U << kNormalBits) - 1;
  constexpr float kUnit = 1.0F / static_cast<float>(kNormalScale);
  const auto part = [&](int place) {
    const std::uint32_t bits = pixel.normal >> (place * kNormalBits) & kMask;
    return static_cast<float>(static_cast<int>(bits) - kNormalZero) * kUnit;
  };
  const float normal_x = part(0);
  const float normal_y = part(1);
  // Of the normal with the ray of the pixel, and with the way from there to that of the other, at depth 1.
  const float ray_x = (pixel.x - params.principal_x) * params.inverse_focal_x;
  const float ray_y = (pixel.y - params.principal_y) * params.inverse_focal_y;
  const float along = normal_x * ray_x + (normal_y * ray_y + part(2));
  const float way_x = (other.x - pixel.x) * params.inverse_focal_x;
  const float way_y = (other.y - pixel.y) * params.inverse_focal_y;
  const float across = normal_x * way_x + normal_y * way_y;
  const float distance = (other.depth - pixel.depth) * along + other.depth * across;
  return pixel.normal == 0 || (distance <= limit && -distance <= limit);
}

/// True if a surface joins two pixels of a depth map that are so many pixels apart.
inline bool joined_on_planes(const SurfacePixel& a, const SurfacePixel& b, float pixels,
                             const RangeSurfaceParams& params) {
  if (!joined(a.depth, b.depth, params.max_step, pixels)) return false;
  if (!(params.agreement > 0.0F) || joined(a.depth, b.depth, params.plane_step, pixels)) return true;
  const float nearer = a.depth < b.depth ? a.depth : b.depth;
  const float limit = (params.agreement * nearer) * pixels;
  return holds(a, b, limit, params) || holds(b, a, limit, params);
}

}  // namespace quorum
