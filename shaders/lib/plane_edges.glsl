// Which neighboring pixels a surface joins. Where depth steps steeply, one of the two must lie on the other's plane.
// Twin: engine/volume/plane_edges.h.

// A pixel of a depth map. normal: of its plane, a word as layout.h has it.
struct SurfacePixel {
  float x;
  float y;
  float depth;
  uint normal;
};

float normal_part(uint normal, int place) {
  const float unit = 1.0 / float(kNormalScale);
  uint bits = normal >> (place * kNormalBits) & ((1u << kNormalBits) - 1u);
  precise float part = float(int(bits) - kNormalZero) * unit;
  return part;
}

bool holds(SurfacePixel pixel, SurfacePixel other, float limit, RangeSurfaceParams params) {
  float normal_x = normal_part(pixel.normal, 0);
  float normal_y = normal_part(pixel.normal, 1);
  float normal_z = normal_part(pixel.normal, 2);
  precise float ray_x = (pixel.x - params.principal_x) * params.inverse_focal_x;
  precise float ray_y = (pixel.y - params.principal_y) * params.inverse_focal_y;
  precise float along = normal_x * ray_x + (normal_y * ray_y + normal_z);
  precise float way_x = (other.x - pixel.x) * params.inverse_focal_x;
  precise float way_y = (other.y - pixel.y) * params.inverse_focal_y;
  precise float across = normal_x * way_x + normal_y * way_y;
  precise float distance = (other.depth - pixel.depth) * along + other.depth * across;
  return pixel.normal == 0u || (distance <= limit && -distance <= limit);
}

bool joined_on_planes(SurfacePixel a, SurfacePixel b, float pixels, RangeSurfaceParams params) {
  if (!joined(a.depth, b.depth, params.max_step, pixels)) return false;
  if (!(params.agreement > 0.0) || joined(a.depth, b.depth, params.plane_step, pixels)) return true;
  float nearer = a.depth < b.depth ? a.depth : b.depth;
  precise float limit = (params.agreement * nearer) * pixels;
  return holds(a, b, limit, params) || holds(b, a, limit, params);
}
