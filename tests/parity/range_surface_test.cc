#include "engine/volume/range_surface.h"

#include "engine/volume/depth_normals.h"
#include "tests/parity/parity_test.h"
#include "tests/parity/surface_input.h"
#include "tests/support/range_params.h"

namespace quorum {
namespace {

class RangeSurfaceParity : public ParityTest {
 protected:
  static Grid<std::uint32_t> compare(const Grid<float>& depth, const RangeSurfaceParams& params,
                                     const std::string& what, const Grid<std::uint32_t>& normals = {}) {
    const Buffer cells = buffer_of(std::vector<std::uint32_t>(depth.values.size(), 0xffffU));
    const Buffer words = buffer_of(normals.empty() ? std::vector<std::uint32_t>(1) : normals.values);
    run(kernel("range_surface"), {depth.width, depth.height}, params, {buffer_of(depth.values), words, cells});
    Grid<std::uint32_t> twin = range_surface(depth, params, normals);
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
      options.plane_agreement = 0;
      const auto params = make_range_surface_params(view.camera, view.width, view.height, options);
      const auto cells = compare(map.depth, params, fmt::format("seed {} slope {}", seed, slope));
      std::array<int, 8> kinds = {};
      for (const std::uint32_t cell : cells.values) ++kinds.at(cell);
      for (const std::size_t kind : {0, 1, 2, 3, 5, 6, 7}) EXPECT_GT(kinds[kind], 5) << "trivial input, cell " << kind;
      if (HasFailure()) return;
    }
  }
}

TEST_F(RangeSurfaceParity, EdgesOnNoisyPlanesGiveTheBytesOfTheTwin) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SphereScene sphere = make_sphere_scene(2, 131, 67 + static_cast<int>(seed), true, seed);
    const View& view = sphere.scene.views[seed % 2];
    const DepthMap map = noisy_sphere_map(view, seed, 40);
    std::mt19937 random(seed);
    std::normal_distribution<float> part(0, 0.2F);
    Grid<Eigen::Vector3f> normals = depth_normals(map.depth, view.camera);
    for (Eigen::Vector3f& normal : normals.values)
      normal = random() % 10 == 0
                   ? Eigen::Vector3f::Zero()
                   : Eigen::Vector3f((normal + Eigen::Vector3f(part(random), part(random), part(random))).normalized());
    FusionOptions options;
    options.max_slope_deg = 89;
    options.plane_agreement = std::array{0.1, 0.3, 1.0}[seed - 1];
    const auto params = make_range_surface_params(view.camera, view.width, view.height, options);
    const auto cells = compare(map.depth, params, fmt::format("seed {}", seed), pack_normals(normals));
    const auto without = range_surface(map.depth, params);
    std::int64_t broken = 0;
    for (std::size_t i = 0; i < cells.values.size(); ++i) broken += cells.values[i] != without.values[i] ? 1 : 0;
    expect_share(broken, static_cast<std::int64_t>(cells.values.size()), 0.01, 0.9, "cells that planes break");
  }
}

TEST_F(RangeSurfaceParity, TheSmallestMapsGiveTheBytesOfTheTwin) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 70}, {70, 1}, {2, 2}, {65, 2}})
    compare(Grid<float>(width, height, 2.5F), slope_alone(width, height, 0.01F), fmt::format("{}x{}", width, height));
}

}  // namespace
}  // namespace quorum
