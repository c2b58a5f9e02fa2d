#include "engine/volume/carve_blocks.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <random>

#include "engine/volume/integrate.h"
#include "engine/volume/weigh_surface.h"
#include "tests/parity/parity_test.h"
#include "tests/parity/surface_input.h"

namespace quorum {
namespace {

class CarveBlocksParity : public ParityTest {};

TEST_F(CarveBlocksParity, ViewsOverAGridInPartsGiveTheBitsOfTheTwin) {
  const Kernel carve_kernel = kernel("carve_blocks");
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SphereScene sphere = make_sphere_scene(3, 131, 67, true, seed);
    FusionOptions options;
    options.max_slope_deg = 89;
    options.voxel_size = std::array{0.05, 0.07, 0.04}[seed - 1];
    const VoxelGrid grid = make_voxel_grid(sphere.scene, options).value();
    // The kernel sees each part as a buffer of its own, and of each part every fifth block is not listed.
    const auto first_part = static_cast<std::uint32_t>(grid.block_count() / 3 | 1);
    std::vector<std::uint32_t> lists[2];
    for (std::uint32_t index = 0; index < grid.block_count(); ++index)
      if (index % 5 != seed) lists[index < first_part ? 0 : 1].push_back(index);
    std::vector<BlockBits> twin(grid.block_count());
    const Buffer low = buffer_of(std::vector<BlockBits>(first_part));
    const Buffer high = buffer_of(std::vector<BlockBits>(grid.block_count() - first_part));
    std::mt19937 random(seed);
    for (std::size_t index = 0; index < sphere.scene.views.size(); ++index) {
      const View& view = sphere.scene.views[index];
      DepthMap map = noisy_sphere_map(view, seed * 10 + static_cast<unsigned>(index), 100);
      for (float& depth : map.depth.values)
        if (depth <= 0.0F && random() % 50 != 0) depth = kBackgroundDepth;
      if (index == 0) map.depth.values.back() = kBackgroundDepth;
      const auto cells =
          range_surface(map.depth, make_range_surface_params(view.camera, view.width, view.height, options));
      const auto weights = weigh_surface(map.depth, map.confidence, cells,
                                         make_weigh_surface_params(view.camera, view.width, view.height, options));
      IntegrateParams params = make_integrate_params(view.camera, view.width, view.height, grid);
      for (const auto& list : lists) carve_blocks({map.depth, cells, weights}, list, params, best_simd_level(), twin);

      const Buffer depth = buffer_of(map.depth.values);
      const Buffer cell_buffer = buffer_of(cells.values);
      const Buffer weight_buffer = buffer_of(weights.values);
      for (const std::size_t part : {0U, 1U}) {
        const Buffer list_buffer = buffer_of(lists[part]);
        params.pool_begin = part == 0 ? 0 : static_cast<int>(first_part);
        run(carve_kernel, {static_cast<std::int64_t>(lists[part].size() * sizeof(BlockBits) / 4)}, params,
            {depth, cell_buffer, weight_buffer, list_buffer, part == 0 ? low : high});
      }
    }
    auto on_device = content<BlockBits>(low);
    const auto rest = content<BlockBits>(high);
    on_device.insert(on_device.end(), rest.begin(), rest.end());
    ASSERT_TRUE(same_words(on_device, twin, 1, fmt::format("seed {}, block", seed)));
    std::int64_t empty = 0;
    for (const BlockBits& block : twin)
      for (const std::uint64_t word : block) empty += std::popcount(word);
    expect_share(empty, static_cast<std::int64_t>(twin.size()) * kBlockVoxels, 0.1, 0.75, "empty voxels");
  }
}

}  // namespace
}  // namespace quorum
