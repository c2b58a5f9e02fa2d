#include "engine/volume/collect_blocks.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace quorum {
namespace {

/// First and last block that a point and its margin touch along one axis, cut to the grid.
struct BlockSpan {
  int first;
  int last;
};

/// Twin: block_span in shaders/collect_blocks.comp.
BlockSpan block_span(float position, float margin, int blocks) {
  const float size = static_cast<float>(blocks);
  const float low = std::clamp(position - margin, -1.0F, size);
  const float high = std::clamp(position + margin, -1.0F, size);
  return {std::max(static_cast<int>(std::floor(low)), 0), std::min(static_cast<int>(std::floor(high)), blocks - 1)};
}

}  // namespace

CollectParams make_collect_params(const Camera& camera, int width, int height, const VoxelGrid& grid) {
  constexpr double kSpacing = 0.5;  // of points along a ray, blocks
  const double block_size = grid.voxel_size * kBlockSide;
  const Eigen::Matrix3d ray = camera.camera_from_world.transpose() * camera.intrinsics.inverse() / block_size;
  const Eigen::Vector3d origin = (camera.center() - grid.origin) / block_size;
  CollectParams params;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      params.ray_from_pixel[3 * row + column] = static_cast<float>(ray(row, column));
    params.origin[row] = static_cast<float>(origin(row));
    params.blocks[row] = grid.blocks[static_cast<std::size_t>(row)];
  }
  params.width = width;
  params.height = height;
  params.steps = static_cast<int>(std::ceil(grid.truncation / (kSpacing * block_size)));
  params.depth_step = static_cast<float>(grid.truncation / params.steps);
  // Half the spacing, and a block's share for the surface between this pixel and the next.
  params.margin = static_cast<float>(kSpacing / 2.0 + 1.0 / kBlockSide);
  return params;
}

std::vector<std::uint32_t> collect_blocks(const Grid<float>& depth, const Grid<std::uint32_t>& weights,
                                          const CollectParams& params) {
  const std::size_t block_count = static_cast<std::size_t>(params.blocks[0]) *
                                  static_cast<std::size_t>(params.blocks[1]) *
                                  static_cast<std::size_t>(params.blocks[2]);
  std::vector<std::uint32_t> bits((block_count + 31) / 32);
  const float* m = params.ray_from_pixel;
  tbb::parallel_for(0, params.height, [&](int y) {
    for (int x = 0; x < params.width; ++x) {
      if (weights.at(x, y) == 0) continue;
      const float fx = static_cast<float>(x);
      const float fy = static_cast<float>(y);
      const float ray_x = m[0] * fx + (m[1] * fy + m[2]);
      const float ray_y = m[3] * fx + (m[4] * fy + m[5]);
      const float ray_z = m[6] * fx + (m[7] * fy + m[8]);
      for (int step = -params.steps; step <= params.steps; ++step) {
        const float d = depth.at(x, y) + static_cast<float>(step) * params.depth_step;
        const BlockSpan span_x = block_span(params.origin[0] + ray_x * d, params.margin, params.blocks[0]);
        const BlockSpan span_y = block_span(params.origin[1] + ray_y * d, params.margin, params.blocks[1]);
        const BlockSpan span_z = block_span(params.origin[2] + ray_z * d, params.margin, params.blocks[2]);
        for (int bz = span_z.first; bz <= span_z.last; ++bz) {
          for (int by = span_y.first; by <= span_y.last; ++by) {
            for (int bx = span_x.first; bx <= span_x.last; ++bx) {
              const auto index = static_cast<std::uint32_t>(bx + params.blocks[0] * (by + params.blocks[1] * bz));
              const std::uint32_t bit = 1U << (index % 32);
              std::atomic_ref<std::uint32_t> word(bits[index / 32]);
              if ((word.load(std::memory_order_relaxed) & bit) == 0) word.fetch_or(bit, std::memory_order_relaxed);
            }
          }
        }
      }
    }
  });
  return bits;
}

std::vector<std::uint32_t> block_indices(const std::vector<std::uint32_t>& bits) {
  std::vector<std::uint32_t> indices;
  for (std::size_t word = 0; word < bits.size(); ++word)
    for (std::uint32_t rest = bits[word]; rest != 0; rest &= rest - 1)
      indices.push_back(static_cast<std::uint32_t>(word * 32) + static_cast<std::uint32_t>(std::countr_zero(rest)));
  return indices;
}

}  // namespace quorum
