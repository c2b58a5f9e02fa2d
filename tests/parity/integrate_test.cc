#include "engine/volume/integrate.h"

#include <random>

#include "engine/volume/weigh_surface.h"
#include "tests/parity/parity_test.h"
#include "tests/parity/surface_input.h"

namespace quorum {
namespace {

class IntegrateParity : public ParityTest {};

TEST_F(IntegrateParity, ViewsOverAPoolInPartsGiveTheBytesOfTheTwin) {
  const Kernel integrate_kernel = kernel("integrate");
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SphereScene sphere = make_sphere_scene(3, 131, 67, true, seed);
    FusionOptions options;
    options.max_slope_deg = 89;
    options.voxel_size = std::array{0.05, 0.07, 0.04}[seed - 1];
    options.truncation = std::array{3.0, 4.0, 1.7}[seed - 1] * options.voxel_size;
    const VoxelGrid grid = make_voxel_grid(sphere.scene, options).value();
    std::mt19937 random(seed);
    std::vector<std::uint32_t> stored;
    for (std::uint32_t index = 0; index < grid.block_count(); ++index)
      if (random() % 4 != 0) stored.push_back(index);

    // The first part of the pool has an odd number of blocks; the kernel sees each part as a buffer of its own.
    const std::size_t first_part = stored.size() / 3 | 1;
    std::vector<Voxel> twin(stored.size() * kBlockVoxels);
    const Buffer low = buffer_of(std::vector<Voxel>(first_part * kBlockVoxels));
    const Buffer high = buffer_of(std::vector<Voxel>((stored.size() - first_part) * kBlockVoxels));
    for (std::size_t index = 0; index < sphere.scene.views.size(); ++index) {
      const View& view = sphere.scene.views[index];
      const DepthMap map = noisy_sphere_map(view, seed * 10 + static_cast<unsigned>(index), 100);
      const PaddedImage image = pad_image(sphere.images[index]);
      const auto cells =
          range_surface(map.depth, make_range_surface_params(view.camera, view.width, view.height, options));
      const auto weights = weigh_surface(map.depth, map.confidence, cells,
                                         make_weigh_surface_params(view.camera, view.width, view.height, options));
      IntegrateParams params = make_integrate_params(view.camera, view.width, view.height, grid);
      const auto list = find_slots(stored, stored);
      integrate({map.depth, cells, weights, image}, list, params, best_simd_level(), twin);

      const Buffer depth = buffer_of(map.depth.values);
      const Buffer cell_buffer = buffer_of(cells.values);
      const Buffer weight_buffer = buffer_of(weights.values);
      const Buffer pixels = buffer_of(image.pixels);
      const Buffer list_buffer = buffer_of(list);
      run(integrate_kernel, {kBlockSide * kBlockSide, static_cast<std::int64_t>(first_part)}, params,
          {depth, cell_buffer, weight_buffer, pixels, list_buffer, low});
      params.list_begin = params.pool_begin = static_cast<int>(first_part);
      run(integrate_kernel, {kBlockSide * kBlockSide, static_cast<std::int64_t>(stored.size() - first_part)}, params,
          {depth, cell_buffer, weight_buffer, pixels, list_buffer, high});
    }
    auto on_device = content<Voxel>(low);
    const auto rest = content<Voxel>(high);
    on_device.insert(on_device.end(), rest.begin(), rest.end());
    ASSERT_TRUE(same_words(on_device, twin, kBlockVoxels, fmt::format("seed {}, (voxel, slot)", seed)));
    const auto seen = std::ranges::count_if(twin, [](const Voxel& voxel) { return voxel.weight > 0; });
    expect_share(seen, static_cast<std::int64_t>(twin.size()), 0.005, 0.9, "seen voxels");
    EXPECT_GT(seen, 1000);
    const auto inside = std::ranges::count_if(twin, [](const Voxel& voxel) { return voxel.distance < 0; });
    expect_share(inside, seen, 0.1, 0.9, "seen voxels behind the surface");
  }
}

}  // namespace
}  // namespace quorum
