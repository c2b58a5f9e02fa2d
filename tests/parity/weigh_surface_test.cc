#include "engine/volume/weigh_surface.h"

#include "tests/parity/parity_test.h"
#include "tests/parity/surface_input.h"

namespace quorum {
namespace {

class WeighSurfaceParity : public ParityTest {};

TEST_F(WeighSurfaceParity, NoisyMapsGiveTheBytesOfTheTwin) {
  const Kernel weigh = kernel("weigh_surface");
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SphereScene sphere = make_sphere_scene(2, 131, 67 + static_cast<int>(seed), true, seed);
    const View& view = sphere.scene.views[seed % 2];
    const DepthMap map = noisy_sphere_map(view, seed, seed == 3 ? 0 : 300);
    for (const int feather : {0, 1, 4, 8}) {
      FusionOptions options;
      options.feather = feather;
      options.max_slope_deg = seed == 1 ? 85 : 70;
      options.weigh_confidence = !(seed == 2 && feather == 1);
      options.weigh_slant = !(seed == 2 && feather == 4);
      options.weigh_border = !(seed == 2 && feather == 8);
      options.signed_distance = seed == 3 ? SignedDistance::kRay : SignedDistance::kNormal;
      const auto cells =
          range_surface(map.depth, make_range_surface_params(view.camera, view.width, view.height, options));
      const auto params = make_weigh_surface_params(view.camera, view.width, view.height, options);
      const Buffer weights = buffer_of(std::vector<std::uint32_t>(map.depth.values.size(), 0xffffU));
      run(weigh, {view.width, view.height}, params,
          {buffer_of(map.depth.values), buffer_of(map.confidence.values), buffer_of(cells.values), weights});
      const auto twin = weigh_surface(map.depth, map.confidence, cells, params);
      ASSERT_TRUE(same_words(content<std::uint32_t>(weights), twin.values, view.width,
                             fmt::format("seed {} feather {}", seed, feather)));
      const auto weighted =
          std::ranges::count_if(twin.values, [](std::uint32_t word) { return (word & kWeightScale) > 1; });
      expect_share(weighted, static_cast<std::int64_t>(twin.values.size()), 0.05, 0.8, "weighted vertices");
    }
  }
}

}  // namespace
}  // namespace quorum
