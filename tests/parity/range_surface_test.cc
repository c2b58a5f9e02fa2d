#include "engine/volume/range_surface.h"

#include "tests/parity/parity_test.h"
#include "tests/parity/surface_input.h"

namespace quorum {
namespace {

class RangeSurfaceParity : public ParityTest {
 protected:
  static Grid<std::uint32_t> compare(const Grid<float>& depth, float max_step, const std::string& what) {
    const RangeSurfaceParams params{depth.width, depth.height, max_step};
    const Buffer cells = buffer_of(std::vector<std::uint32_t>(depth.values.size(), 0xffffU));
    run(kernel("range_surface"), {depth.width, depth.height}, params, {buffer_of(depth.values), cells});
    Grid<std::uint32_t> twin = range_surface(depth, params);
    same_words(content<std::uint32_t>(cells), twin.values, depth.width, what);
    return twin;
  }
};

TEST_F(RangeSurfaceParity, NoisyMapsGiveTheBytesOfTheTwin) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SphereScene sphere = make_sphere_scene(2, 131, 67 + static_cast<int>(seed), true, seed);
    const View& view = sphere.scene.views[seed % 2];
    const DepthMap map = noisy_sphere_map(view, seed, 40);
    for (const double slope : {40.0, 70.0, 89.0}) {
      FusionOptions options;
      options.max_slope_deg = slope;
      const auto params = make_range_surface_params(view.camera, view.width, view.height, options);
      const auto cells = compare(map.depth, params.max_step, fmt::format("seed {} slope {}", seed, slope));
      std::array<int, 8> kinds = {};
      for (const std::uint32_t cell : cells.values) ++kinds.at(cell);
      for (const std::size_t kind : {0, 1, 2, 3, 5, 6, 7}) EXPECT_GT(kinds[kind], 5) << "trivial input, cell " << kind;
      if (HasFailure()) return;
    }
  }
}

TEST_F(RangeSurfaceParity, TheSmallestMapsGiveTheBytesOfTheTwin) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 70}, {70, 1}, {2, 2}, {65, 2}})
    compare(Grid<float>(width, height, 2.5F), 0.01F, fmt::format("{}x{}", width, height));
}

}  // namespace
}  // namespace quorum
