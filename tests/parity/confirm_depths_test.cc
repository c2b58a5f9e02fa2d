#include "engine/volume/confirm_depths.h"

#include <random>

#include "engine/pipeline/cpu_backend.h"
#include "host/vulkan_backend.h"
#include "tests/parity/parity_test.h"
#include "tests/parity/surface_input.h"
#include "tests/support/confirm_task.h"

namespace quorum {
namespace {

class ConfirmDepthsParity : public ParityTest {};

/// The middle view of a few against the others; every second one is upside down.
ConfirmTask noisy_task(unsigned seed, bool with_certainties) {
  const SphereScene sphere = make_sphere_scene(5, 121, 83 + static_cast<int>(seed), true, seed);
  const auto depths = [&](std::size_t index) {
    const View& view = sphere.scene.views[index];
    ViewDepths result{noisy_sphere_map(view, 10 * seed + static_cast<unsigned>(index), 60).depth, view.camera};
    if (with_certainties) {
      result.certainty = Grid<float>(result.depth.width, result.depth.height);
      std::mt19937 random(seed + static_cast<unsigned>(index));
      for (float& certainty : result.certainty.values) certainty = static_cast<float>(random() % 256) / 256.0F;
    }
    return shared(std::move(result));
  };
  ConfirmTask task{depths(2), {}, {}};
  for (const std::size_t other : {0U, 1U, 3U, 4U}) task.others.push_back(depths(other));
  if (with_certainties) {  // a pit, in which the others see what lies in front
    Grid<float>& depth = changed(task.view).depth;
    for (int y = depth.height / 3; y < depth.height * 2 / 3; ++y)
      for (int x = depth.width / 3; x < depth.width * 2 / 3; ++x) depth.at(x, y) *= 1.1F;
  }
  return task;
}

TEST_F(ConfirmDepthsParity, NoisyMapsGiveTheBytesOfTheTwin) {
  const Kernel confirm = kernel("confirm_depths");
  for (const bool denies : {false, true}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      const ConfirmTask task = noisy_task(seed, denies);
      const Grid<float>& depth = task.view->depth;
      Grid<int> twin(depth.width, depth.height, 17);
      const Buffer support = buffer_of(twin.values);
      const Buffer certainty = buffer_of(denies ? task.view->certainty.values : depth.values);
      for (std::size_t other = 0; other < task.others.size(); ++other) {
        const ViewDepths& seen_by = *task.others[other];
        const ConfirmDepthsParams params = make_confirm_depths_params(task, other);
        run(confirm, {depth.width, depth.height}, params,
            {buffer_of(depth.values), buffer_of(seen_by.depth.values), certainty,
             buffer_of(denies ? seen_by.certainty.values : seen_by.depth.values), support});
        confirm_depths(*task.view, seen_by, params, best_simd_level(), twin);
        ASSERT_TRUE(same_words(content<std::int32_t>(support), twin.values, depth.width,
                               fmt::format("seed {} other view {} denies {}", seed, other, denies)));
      }
      const auto whole = static_cast<std::int64_t>(twin.values.size());
      const auto share = [&](int low, int high) {
        return std::ranges::count_if(twin.values, [=](int value) { return value >= low && value <= high; });
      };
      expect_share(share(-4, -1), whole, 0.002, 0.5, "contradicted depths");
      expect_share(share(1, 15), whole, 0.05, 0.9, "depths with some support");
      expect_share(share(16, 16), whole, 0.01, 0.5, "depths with all support");
      if (denies) expect_share(share(4 * kSupportOfDenial, kSupportOfDenial / 2), whole, 0.002, 0.5, "denied depths");
    }
  }
}

TEST_F(ConfirmDepthsParity, BackendsGiveTheSameCertainty) {
  CpuBackend cpu;
  const auto gpu = VulkanBackend::create(device()).value();
  for (const bool denies : {false, true}) {
    ConfirmTask task = noisy_task(4, denies);
    for (const std::size_t others : {4U, 1U, 0U}) {
      task.others.resize(others);
      const Grid<float> twin = cpu.confirm_depths(task).value();
      const Grid<float> on_device = gpu->confirm_depths(task).value();
      EXPECT_TRUE(
          same_words(on_device.values, twin.values, twin.width, fmt::format("{} others denies {}", others, denies)));
    }
  }
}

}  // namespace
}  // namespace quorum
