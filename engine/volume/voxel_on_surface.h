// The voxels of a block against a range surface: where they project, in which triangle, and how far before it they lie.
// Phases over plain arrays, so that the compiler vectorizes all but the reads; inlined into functions that are compiled
// for several instruction sets. What integrate and carve_blocks share. Twin: shaders/lib/voxel_on_surface.glsl.
#pragma once

#include <array>
#include <cstdint>

#include "engine/core/exact.h"
#include "engine/core/grid.h"
#include "engine/volume/cell.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// What is known of a block's voxels. First of all of them, in the order of the pool; then the arrays hold the voxels
/// that go on, one after the other.
struct BlockOnSurface {
  float u[kBlockVoxels];  // position in the view, pixels
  float v[kBlockVoxels];
  float depth[kBlockVoxels];          // along the optical axis
  std::int32_t pixel[kBlockVoxels];   // index of the cell's first
  std::uint32_t sides[kBlockVoxels];  // kSide… of the position in its cell

  // Of those that go on.
  std::int32_t voxel[kBlockVoxels];      // number in the block
  std::uint32_t triangle[kBlockVoxels];  // kSideCount times the bits of the cell, and kSide… bits
  float corner[4][kBlockVoxels];         // depths of the cell
  std::int32_t cosines[kBlockVoxels];    // sum of those at both ends of the cell's diagonal, in 1/kCosineScale
};

/// The first voxel of the block with this index.
inline std::array<int, 3> first_voxel(const IntegrateParams& params, std::uint32_t index) {
  const int i = static_cast<int>(index);
  const int* blocks = params.blocks;
  return {i % blocks[0] * kBlockSide, i / blocks[0] % blocks[1] * kBlockSide, i / (blocks[0] * blocks[1]) * kBlockSide};
}

// On which side of the cell's diagonals a position lies.
constexpr std::uint32_t kSideBelow03 = 1;  // in the second triangle of a cell that is split along 0-3
constexpr std::uint32_t kSideBelow12 = 2;  // in the second triangle of a cell that is split along 1-2
constexpr std::uint32_t kSideCount = 4;

constexpr bool is_split_03(std::uint32_t triangle) { return (triangle & kCellSplitAlong03 * kSideCount) != 0; }
constexpr bool is_second(std::uint32_t triangle) {
  return (triangle & (is_split_03(triangle) ? kSideBelow03 : kSideBelow12)) != 0;
}

/// Bit i: whether BlockOnSurface::triangle i is one that the surface has.
constexpr std::uint32_t kExists = [] {
  std::uint32_t bits = 0;
  for (std::uint32_t triangle = 0; triangle < 32; ++triangle) {
    const std::uint32_t cell = triangle / kSideCount;
    const bool exists = (cell & (is_second(triangle) ? kCellSecondTriangle : kCellFirstTriangle)) != 0;
    bits |= exists ? 1U << triangle : 0U;
  }
  return bits;
}();

/// How far a position in pixels, 0 or more, lies in its cell, along one axis.
[[gnu::always_inline]] inline float fraction_in_cell(float position) {
  return position - static_cast<float>(static_cast<int>(position));
}

/// Projects all voxels of the block whose first one is (x, y, z). Those that the view does not see get the last pixel,
/// which has no triangle.
[[gnu::always_inline]] inline void project_block(const IntegrateParams& params, int x, int y, int z,
                                                 BlockOnSurface& work) {
  constexpr int kLayer = kBlockSide * kBlockSide;
  float column[kLayer];
  float row[kLayer];
  for (int i = 0; i < kLayer; ++i) {
    column[i] = static_cast<float>(x + i % kBlockSide);
    row[i] = static_cast<float>(y + i / kBlockSide);
  }
  const float* p = params.projection;
  const float limit_u = static_cast<float>(params.width - 1);
  const float limit_v = static_cast<float>(params.height - 1);
  const int width = params.width;
  const int last_pixel = params.width * params.height - 1;
  for (int layer = 0; layer < kBlockSide; ++layer) {
    const float fz = static_cast<float>(z + layer);
    const float base_x = p[2] * fz + p[3];
    const float base_y = p[6] * fz + p[7];
    const float base_z = p[10] * fz + p[11];
    const float p0 = p[0], p1 = p[1], p4 = p[4], p5 = p[5], p8 = p[8], p9 = p[9];
    float* layer_u = work.u + layer * kLayer;
    float* layer_v = work.v + layer * kLayer;
    float* layer_depth = work.depth + layer * kLayer;
    std::int32_t* layer_pixel = work.pixel + layer * kLayer;
    std::uint32_t* layer_sides = work.sides + layer * kLayer;
    for (int i = 0; i < kLayer; ++i) {
      const float pz = p8 * column[i] + (p9 * row[i] + base_z);
      const float px = p0 * column[i] + (p1 * row[i] + base_x);
      const float py = p4 * column[i] + (p5 * row[i] + base_y);
      const bool before = pz > 0.0F;
      const float inverse_z = reciprocal(before ? pz : 1.0F);
      const float u = px * inverse_z;
      const float v = py * inverse_z;
      const bool in = before & (u >= 0.0F) & (v >= 0.0F) & (u < limit_u) & (v < limit_v);
      const float inside_u = in ? u : 0.0F;
      const float inside_v = in ? v : 0.0F;
      const int cell_x = static_cast<int>(inside_u);
      const int cell_y = static_cast<int>(inside_v);
      const float fraction_x = fraction_in_cell(inside_u);
      const float fraction_y = fraction_in_cell(inside_v);
      layer_u[i] = inside_u;
      layer_v[i] = inside_v;
      layer_depth[i] = pz;
      const std::uint32_t below_03 = fraction_x < fraction_y ? kSideBelow03 : 0U;
      const std::uint32_t below_12 = fraction_x + fraction_y > 1.0F ? kSideBelow12 : 0U;
      const int outside = in ? 0 : last_pixel;
      layer_pixel[i] = cell_y * width + cell_x + outside;
      layer_sides[i] = below_03 + below_12;
    }
  }
}

/// Keeps the voxels that land in a triangle, and reads its cell's depths and cosines. Returns how many.
[[gnu::always_inline]] inline int keep_on_surface(const Grid<float>& depths, const Grid<std::uint32_t>& all_cells,
                                                  const Grid<std::uint32_t>& all_weights, BlockOnSurface& work) {
  const std::uint32_t* cells = all_cells.values.data();
  int count = 0;
  for (int i = 0; i < kBlockVoxels; ++i) {
    const std::uint32_t triangle = cells[work.pixel[i]] * kSideCount + work.sides[i];
    work.voxel[count] = i;
    work.triangle[count] = triangle;
    count += static_cast<int>(kExists >> triangle & 1U);
  }
  const std::ptrdiff_t width = depths.width;
  for (int i = 0; i < count; ++i) {
    const int from = work.voxel[i];
    work.u[i] = work.u[from];
    work.v[i] = work.v[from];
    work.depth[i] = work.depth[from];
    work.pixel[i] = work.pixel[from];
    const float* depth = depths.values.data() + work.pixel[i];
    work.corner[0][i] = depth[0];
    work.corner[1][i] = depth[1];
    work.corner[2][i] = depth[width];
    work.corner[3][i] = depth[width + 1];
    const std::uint32_t* weights = all_weights.values.data() + work.pixel[i];
    const std::ptrdiff_t first = is_split_03(work.triangle[i]) ? 0 : 1;
    work.cosines[i] =
        static_cast<std::int32_t>((weights[first] >> kWeightBits) + (weights[width + 1 - first] >> kWeightBits));
  }
  return count;
}

/// How far voxels lie before the surface.
class SurfaceMeasure {
 public:
  [[gnu::always_inline]] explicit SurfaceMeasure(const IntegrateParams& params)
      : principal_x_(params.principal_x),
        principal_y_(params.principal_y),
        inverse_focal_x_(params.inverse_focal_x),
        inverse_focal_y_(params.inverse_focal_y),
        inverse_truncation_(params.inverse_truncation) {}

  /// Of the i-th voxel that keep_on_surface kept, in units of the truncation; negative behind the surface.
  [[gnu::always_inline, nodiscard]] float distance(const BlockOnSurface& work, int i) const {
    constexpr float kMeanOfCosines = 0.5F / static_cast<float>(kCosineScale);
    const float u = work.u[i];
    const float v = work.v[i];
    const float fraction_x = fraction_in_cell(u);
    const float fraction_y = fraction_in_cell(v);
    const float ray_x = (u - principal_x_) * inverse_focal_x_;
    const float ray_y = (v - principal_y_) * inverse_focal_y_;
    const float ray_squared = ray_x * ray_x + (ray_y * ray_y + 1.0F);
    const float ray_length = ray_squared * reciprocal_sqrt(ray_squared);
    const float surface_depth =
        interpolate_cell(is_split_03(work.triangle[i]), is_second(work.triangle[i]), work.corner[0][i],
                         work.corner[1][i], work.corner[2][i], work.corner[3][i], fraction_x, fraction_y);
    const float cosine = static_cast<float>(work.cosines[i]) * kMeanOfCosines;
    return (((surface_depth - work.depth[i]) * ray_length) * cosine) * inverse_truncation_;
  }

 private:
  float principal_x_;
  float principal_y_;
  float inverse_focal_x_;
  float inverse_focal_y_;
  float inverse_truncation_;
};

}  // namespace quorum
