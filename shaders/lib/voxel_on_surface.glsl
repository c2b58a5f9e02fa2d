// A voxel against a range surface: where it projects, in which triangle, and how far before it it lies.
// For kernels that declare IntegrateParams p and the buffers depth, cells and weights.
// Twin: engine/volume/voxel_on_surface.h.

// The first voxel of the block with this index.
ivec3 first_voxel(int index) {
  return kBlockSide *
         ivec3(index % p.blocks[0], index / p.blocks[0] % p.blocks[1], index / (p.blocks[0] * p.blocks[1]));
}

// The projection, row by row.
struct Projector {
  vec4 x;
  vec4 y;
  vec4 z;
};

// Where a voxel lies in the view: pixels, and along the optical axis.
struct Position {
  float u;
  float v;
  float depth;
};

Position project_voxel(Projector m, float x, float y, float z) {
  precise float pz = m.z.x * x + (m.z.y * y + (m.z.z * z + m.z.w));
  precise float px = m.x.x * x + (m.x.y * y + (m.x.z * z + m.x.w));
  precise float py = m.y.x * x + (m.y.y * y + (m.y.z * z + m.y.w));
  float inverse_z = reciprocal(pz > 0.0 ? pz : 1.0);
  precise float u = px * inverse_z;
  precise float v = py * inverse_z;
  return Position(u, v, pz);
}

Projector make_projector() {
  return Projector(vec4(p.projection[0], p.projection[1], p.projection[2], p.projection[3]),
                   vec4(p.projection[4], p.projection[5], p.projection[6], p.projection[7]),
                   vec4(p.projection[8], p.projection[9], p.projection[10], p.projection[11]));
}

// pixel: the first of its cell; the last pixel, which has no triangle, if the view does not see the voxel.
struct VoxelOnSurface {
  int pixel;
  vec2 fraction;  // of the position in its cell
  bool split_03;
  bool second;  // of the cell's triangles
  bool on_surface;
};

VoxelOnSurface find_on_surface(Position at, int width, float limit_u, float limit_v, int last_pixel) {
  bool inside = at.depth > 0.0 && at.u >= 0.0 && at.v >= 0.0 && at.u < limit_u && at.v < limit_v;
  int cell_x = int(inside ? at.u : 0.0);
  int cell_y = int(inside ? at.v : 0.0);
  precise vec2 fraction = vec2(at.u - float(cell_x), at.v - float(cell_y));
  int pixel = inside ? cell_y * width + cell_x : last_pixel;
  uint cell = cells[pixel];
  bool split_03 = (cell & kCellSplitAlong03) != 0u;
  precise float fraction_sum = fraction.x + fraction.y;
  bool second = split_03 ? fraction.x < fraction.y : fraction_sum > 1.0;
  bool on_surface = (cell & (second ? kCellSecondTriangle : kCellFirstTriangle)) != 0u;
  return VoxelOnSurface(pixel, fraction, split_03, second, on_surface);
}

// In units of the truncation, negative behind the surface; anything where the voxel is not on it.
float distance_before(VoxelOnSurface voxel, Position at, int width) {
  const float mean_of_cosines = 0.5 / float(kCosineScale);
  int corner = voxel.on_surface ? voxel.pixel : 0;
  vec4 depths = vec4(depth[corner], depth[corner + 1], depth[corner + width], depth[corner + width + 1]);
  precise float ray_x = (at.u - p.principal_x) * p.inverse_focal_x;
  precise float ray_y = (at.v - p.principal_y) * p.inverse_focal_y;
  precise float ray_squared = ray_x * ray_x + (ray_y * ray_y + 1.0);
  precise float ray_length = ray_squared * reciprocal_sqrt(ray_squared);
  // Both ends of the cell's diagonal.
  uint cosines = (weights[corner + (voxel.split_03 ? 0 : 1)] >> kWeightBits) +
                 (weights[corner + width + (voxel.split_03 ? 1 : 0)] >> kWeightBits);
  precise float cosine = float(int(cosines)) * mean_of_cosines;
  precise float distance =
      (((interpolate_cell(voxel.split_03, voxel.second, depths, voxel.fraction) - at.depth) * ray_length) * cosine) *
      p.inverse_truncation;
  return distance;
}
