#include "engine/volume/carve_blocks.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "engine/volume/voxel_on_surface.h"

namespace quorum {
namespace {

/// What a tile of the view shows at most.
struct Tile {
  float farthest = 0.0F;  ///< depth; 0 = none
  bool background = false;
};

constexpr int kTileSide = 16;  // pixels

Grid<Tile> make_tiles(const Grid<float>& depth) {
  Grid<Tile> tiles((depth.width + kTileSide - 1) / kTileSide, (depth.height + kTileSide - 1) / kTileSide);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      Tile& tile = tiles.at(x / kTileSide, y / kTileSide);
      tile.farthest = std::max(tile.farthest, depth.at(x, y));
      tile.background = tile.background || depth.at(x, y) < 0.0F;
    }
  }
  return tiles;
}

/// True if the view may look through the block; what is near it counts as in it, so that rounding does not matter.
bool in_sight(const Grid<Tile>& tiles, const Grid<float>& depth, const Camera& camera, const VoxelGrid& grid,
              std::uint32_t index) {
  constexpr double kMargin = 2.0;    // pixels
  constexpr double kNearer = 0.999;  // of a depth
  const auto [bx, by, bz] = grid.block_position(index);
  const double limit = std::numeric_limits<double>::max();
  Eigen::Vector3d low(limit, limit, limit);  // pixels and depth
  Eigen::Vector3d high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d voxel(bx * kBlockSide + (corner & 1) * (kBlockSide - 1),
                                by * kBlockSide + (corner >> 1 & 1) * (kBlockSide - 1),
                                bz * kBlockSide + (corner >> 2) * (kBlockSide - 1));
    const Eigen::Vector3d pixel = camera.project(grid.origin + grid.voxel_size * voxel);
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  if (high.z() < -grid.voxel_size) return false;
  if (low.z() <= grid.voxel_size) return true;  // the camera may be in it
  const auto first_tile = [](double position) {
    return static_cast<int>(std::max(position - kMargin, 0.0)) / kTileSide;
  };
  const auto last_tile = [](double position, int size) {
    return static_cast<int>(std::clamp(position + kMargin, 0.0, size - 1.0)) / kTileSide;
  };
  if (!(high.x() > -kMargin && high.y() > -kMargin && low.x() < depth.width + kMargin &&
        low.y() < depth.height + kMargin))
    return false;
  for (int y = first_tile(low.y()); y <= last_tile(high.y(), depth.height); ++y)
    for (int x = first_tile(low.x()); x <= last_tile(high.x(), depth.width); ++x)
      if (const Tile& tile = tiles.at(x, y); tile.background || static_cast<double>(tile.farthest) > kNearer * low.z())
        return true;
  return false;
}

/// The block whose first voxel is (x, y, z).
[[gnu::always_inline]] inline void carve_block_body(const CarvingSurface& surface, const IntegrateParams& params, int x,
                                                    int y, int z, BlockBits& empty) {
  BlockOnSurface work;
  project_block(params, x, y, z, work);
  const auto mark = [&empty](std::int32_t voxel, bool is_empty) {
    empty[static_cast<std::size_t>(voxel) / 64] |= static_cast<std::uint64_t>(is_empty) << (voxel % 64);
  };
  const std::int32_t last_pixel = params.width * params.height - 1;
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (work.pixel[i] == last_pixel) continue;
    const float* depth = surface.depth.values.data() + work.pixel[i];
    mark(i, depth[0] < 0.0F && depth[1] < 0.0F && depth[params.width] < 0.0F && depth[params.width + 1] < 0.0F);
  }
  const int count = keep_on_surface(surface.depth, surface.cells, surface.weights, work);
  const SurfaceMeasure measure(params);
  bool before[kBlockVoxels];
  for (int i = 0; i < count; ++i) before[i] = measure.distance(work, i) > 1.0F;
  for (int i = 0; i < count; ++i) mark(work.voxel[i], before[i]);
}

}  // namespace

std::vector<std::uint32_t> blocks_in_sight(const Grid<float>& depth, const Camera& camera, const VoxelGrid& grid) {
  const Grid<Tile> tiles = make_tiles(depth);
  std::vector<char> seen(grid.block_count());
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t index) {
    seen[index] = in_sight(tiles, depth, camera, grid, static_cast<std::uint32_t>(index)) ? 1 : 0;
  });
  std::vector<std::uint32_t> list;
  for (std::uint32_t index = 0; index < seen.size(); ++index)
    if (seen[index] != 0) list.push_back(index);
  return list;
}

void carve_blocks(const CarvingSurface& surface, const std::vector<std::uint32_t>& list, const IntegrateParams& params,
                  SimdLevel simd, std::vector<BlockBits>& empty) {
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  const auto carve_block = simd_form<carve_block_body>(simd);
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t entry) {
    BlockBits& bits = empty[list[entry]];
    if (std::ranges::all_of(bits, [](std::uint64_t word) { return word == kAll; })) return;
    const auto [x, y, z] = first_voxel(params, list[entry]);
    carve_block(surface, params, x, y, z, bits);
  });
}

}  // namespace quorum
