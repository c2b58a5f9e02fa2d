// Inputs of the kernels that compute windows.
#pragma once

#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

#include "engine/depth/sweep_depth.h"
#include "host/depth_stage.h"
#include "host/kernel_layout.h"
#include "tests/support/sphere_scene.h"

namespace quorum {

struct WindowCase {
  int window;
  WindowModel model;
  bool flip;
  int width;
  int height;
  unsigned seed;

  [[nodiscard]] std::string name() const {
    return fmt::format("window {} {} {}x{} flip {} seed {}", window, model == WindowModel::kAxis ? "axis" : "plane",
                       width, height, flip, seed);
  }
  [[nodiscard]] SweepTask task() const {
    SweepOptions options;
    options.window = window;
    options.window_model = model;
    options.step_pixels = 2.0;
    SweepTask result = make_sphere_task(make_sphere_scene(4, width, height, flip, seed), 1, options);
    std::mt19937 random(seed);  // some pixels test nothing, so that blocks have gaps
    for (PlaneRange& range : result.ranges.values)
      if (random() % 8 == 0) range = {1, 0};
    return result;
  }
  [[nodiscard]] std::vector<SpecConstant> constants(SweepForm form, BlockSize block) const {
    std::vector<SpecConstant> constants = {
        {"kWindow", static_cast<std::uint32_t>(window)},
        {"kShift", static_cast<std::uint32_t>(kSampleShift + extra_sample_shift(window))},
        {"kBlockWidth", static_cast<std::uint32_t>(block.width)},
        {"kBlockHeight", static_cast<std::uint32_t>(block.height)}};
    if (form == SweepForm::kLanes) return constants;
    constants.push_back({"kGroupSize", static_cast<std::uint32_t>(block.pixels())});
    constants.push_back({"kAxisModel", model == WindowModel::kAxis ? 1U : 0U});
    return constants;
  }
};

inline std::vector<WindowCase> window_cases() {
  std::vector<WindowCase> cases;
  unsigned seed = 1;
  for (const int window : {3, 5, 9, 15}) {
    cases.push_back({window, WindowModel::kPlane, true, 67, 45, seed++});
    cases.push_back({window, WindowModel::kPlane, false, 131, 61, seed++});
    cases.push_back({window, WindowModel::kAxis, false, 67, 45, seed++});
    cases.push_back({window, WindowModel::kAxis, true, 67, 45, seed++});
  }
  return cases;
}

inline SweepParams window_params(const SweepTask& task, int neighbor) {
  const auto index = static_cast<std::size_t>(neighbor);
  SweepParams params{};
  params.warp = task.warps[index];
  params.width = task.reference->width;
  params.height = task.reference->height;
  params.neighbor_width = task.neighbors[index]->width;
  params.neighbor_height = task.neighbors[index]->height;
  return params;
}

}  // namespace quorum
