#include "engine/volume/collect_blocks.h"

#include "engine/volume/weigh_surface.h"
#include "tests/parity/parity_test.h"
#include "tests/parity/surface_input.h"

namespace quorum {
namespace {

class CollectBlocksParity : public ParityTest {};

TEST_F(CollectBlocksParity, NoisyMapsGiveTheBitsOfTheTwin) {
  const Kernel collect = kernel("collect_blocks");
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SphereScene sphere = make_sphere_scene(3, 131, 67, true, seed);
    const View& view = sphere.scene.views[seed - 1];
    const DepthMap map = noisy_sphere_map(view, seed, 50);
    FusionOptions options;
    options.max_slope_deg = 89;
    options.voxel_size = std::array{0.013, 0.03, 0.08}[seed - 1];
    options.truncation = std::array{3.0, 4.0, 20.0}[seed - 1] * options.voxel_size;
    const VoxelGrid grid = make_voxel_grid(sphere.scene, options).value();
    Grid<std::uint32_t> weights(view.width, view.height);
    for (std::size_t i = 0; i < weights.values.size(); ++i)  // outliers included, whatever the range surface says
      weights.values[i] = map.depth.values[i] > 0 && i % 5 != 0 ? 100 : 0;
    const CollectParams params = make_collect_params(view.camera, view.width, view.height, grid);
    const Buffer bits = buffer_of(std::vector<std::uint32_t>((grid.block_count() + 31) / 32));
    run(collect, {view.width, view.height}, params, {buffer_of(map.depth.values), buffer_of(weights.values), bits});
    const auto twin = collect_blocks(map.depth, weights, params);
    ASSERT_TRUE(same_words(content<std::uint32_t>(bits), twin, 1, fmt::format("seed {}, word", seed)));
    expect_share(static_cast<std::int64_t>(block_indices(twin).size()), static_cast<std::int64_t>(grid.block_count()),
                 0.05, 0.95, "collected blocks");
  }
}

}  // namespace
}  // namespace quorum
