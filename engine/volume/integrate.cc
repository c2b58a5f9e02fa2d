#include "engine/volume/integrate.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/exact.h"

namespace quorum {
namespace {

/// A value at (fraction_x, fraction_y) in a cell, linear on the triangle that holds it.
/// Twin: interpolate_cell in shaders/lib/cell.glsl.
float interpolate_cell(bool split_03, bool second, float v0, float v1, float v2, float v3, float fraction_x,
                       float fraction_y) {
  if (split_03) {
    return second ? v0 + (fraction_y * (v2 - v0) + fraction_x * (v3 - v2))
                  : v0 + (fraction_x * (v1 - v0) + fraction_y * (v3 - v1));
  }
  return second ? v3 + ((1.0F - fraction_x) * (v2 - v3) + (1.0F - fraction_y) * (v1 - v3))
                : v0 + (fraction_x * (v1 - v0) + fraction_y * (v2 - v0));
}

void integrate_voxel(const WeightedSurface& surface, const IntegrateParams& params, int x, int y, int z, Voxel& voxel) {
  const float fx = static_cast<float>(x);
  const float fy = static_cast<float>(y);
  const float fz = static_cast<float>(z);
  const float* p = params.projection;
  const float pz = p[8] * fx + (p[9] * fy + (p[10] * fz + p[11]));
  if (!(pz > 0.0F)) return;
  const float px = p[0] * fx + (p[1] * fy + (p[2] * fz + p[3]));
  const float py = p[4] * fx + (p[5] * fy + (p[6] * fz + p[7]));
  const float inverse_z = reciprocal(pz);
  const float u = px * inverse_z;
  const float v = py * inverse_z;
  if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(params.width - 1) &&
        v < static_cast<float>(params.height - 1)))
    return;
  const int column = static_cast<int>(u);
  const int row = static_cast<int>(v);
  const float fraction_x = u - static_cast<float>(column);
  const float fraction_y = v - static_cast<float>(row);

  const std::uint32_t cell = surface.cells.at(column, row);
  const bool split_03 = (cell & kCellSplitAlong03) != 0;
  const bool second = split_03 ? fraction_x < fraction_y : fraction_x + fraction_y > 1.0F;
  if ((cell & (second ? kCellSecondTriangle : kCellFirstTriangle)) == 0) return;
  const auto on_triangle = [&](const auto& grid) {
    return interpolate_cell(split_03, second, static_cast<float>(grid.at(column, row)),
                            static_cast<float>(grid.at(column + 1, row)), static_cast<float>(grid.at(column, row + 1)),
                            static_cast<float>(grid.at(column + 1, row + 1)), fraction_x, fraction_y);
  };

  const float ray_x = (u - params.principal_x) * params.inverse_focal_x;
  const float ray_y = (v - params.principal_y) * params.inverse_focal_y;
  const float ray_squared = ray_x * ray_x + (ray_y * ray_y + 1.0F);
  const float ray_length = ray_squared * reciprocal_sqrt(ray_squared);
  const float distance = ((on_triangle(surface.depth) - pz) * ray_length) * params.inverse_truncation;
  if (!(distance >= -kBehindShare && distance <= 1.0F)) return;
  const float scale = static_cast<float>(kDistanceScale);
  const int signed_distance = static_cast<int>(distance * scale + (scale + 0.5F)) - kDistanceScale;
  const int weight = static_cast<int>(on_triangle(surface.weights) + 0.5F);

  const Sample sample = sample_bilinear(surface.image, static_cast<int>(u * static_cast<float>(kPositionScale) + 0.5F),
                                        static_cast<int>(v * static_cast<float>(kPositionScale) + 0.5F), 0);
  const auto color = [](int value) { return std::min((value + 2048 + 8) >> 4, 255); };
  voxel.weight += weight;
  voxel.distance += weight * signed_distance;
  voxel.color[0] += weight * color(sample.red);
  voxel.color[1] += weight * color(sample.green);
  voxel.color[2] += weight * color(sample.blue);
}

}  // namespace

IntegrateParams make_integrate_params(const Camera& camera, int width, int height, const VoxelGrid& grid) {
  Eigen::Matrix<double, 3, 4> projection;
  projection.leftCols<3>() = camera.intrinsics * camera.camera_from_world * grid.voxel_size;
  projection.col(3) = camera.intrinsics * camera.to_camera(grid.origin);
  IntegrateParams params{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      params.projection[4 * row + column] = static_cast<float>(projection(row, column));
  const Eigen::Matrix3d& k = camera.intrinsics;
  params.inverse_focal_x = static_cast<float>(1.0 / k(0, 0));
  params.inverse_focal_y = static_cast<float>(1.0 / k(1, 1));
  params.principal_x = static_cast<float>(k(0, 2));
  params.principal_y = static_cast<float>(k(1, 2));
  params.inverse_truncation = static_cast<float>(1.0 / grid.truncation);
  params.width = width;
  params.height = height;
  params.blocks[0] = grid.blocks[0];
  params.blocks[1] = grid.blocks[1];
  return params;
}

std::vector<BlockSlot> find_slots(const std::vector<std::uint32_t>& blocks, const std::vector<std::uint32_t>& pool) {
  std::vector<BlockSlot> slots;
  slots.reserve(blocks.size());
  std::size_t slot = 0;
  for (const std::uint32_t block : blocks) {
    while (slot < pool.size() && pool[slot] < block) ++slot;
    QUORUM_CHECK_LT(slot, pool.size());
    QUORUM_CHECK_EQ(pool[slot], block);
    slots.push_back({block, static_cast<std::uint32_t>(slot)});
  }
  return slots;
}

void integrate(const WeightedSurface& surface, const std::vector<BlockSlot>& list, const IntegrateParams& params,
               std::vector<Voxel>& voxels) {
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t entry) {
    const auto index = static_cast<int>(list[entry].index);
    const int x = index % params.blocks[0] * kBlockSide;
    const int y = index / params.blocks[0] % params.blocks[1] * kBlockSide;
    const int z = index / (params.blocks[0] * params.blocks[1]) * kBlockSide;
    Voxel* voxel = voxels.data() + static_cast<std::size_t>(list[entry].slot) * kBlockVoxels;
    for (int dz = 0; dz < kBlockSide; ++dz)
      for (int dy = 0; dy < kBlockSide; ++dy)
        for (int dx = 0; dx < kBlockSide; ++dx) integrate_voxel(surface, params, x + dx, y + dy, z + dz, *voxel++);
  });
}

}  // namespace quorum
