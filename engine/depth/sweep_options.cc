#include "engine/depth/sweep_options.h"

#include <fmt/format.h>

namespace quorum {

const char* window_model_name(WindowModel model) {
  return model == WindowModel::kSlanted ? "slanted" : model == WindowModel::kPlane ? "plane" : "axis";
}

double SweepOptions::automatic_step_pixels() const {
  if (step_pixels > 0.0) return step_pixels;
  return window_model == WindowModel::kSlanted ? 2.0 : 1.0;
}

Expected<void> SweepOptions::check() const {
  const auto wrong = [](std::string text) { return failure(ErrorKind::kUsage, std::move(text)); };
  if (window < 3 || window > 15 || window % 2 == 0)
    return wrong(fmt::format("--window {}: give an odd number from 3 to 15", window));
  if (second_window != 0 && (second_window <= window || second_window > 15 || second_window % 2 == 0))
    return wrong(fmt::format("--second-window {}: give an odd number above --window {}, up to 15, or 0 for none",
                             second_window, window));
  if (!(threshold >= 0.0F && threshold <= 0.99F))
    return wrong(fmt::format("--threshold {}: give a number from 0 to 0.99", threshold));
  if (min_votes < 1 || min_votes > 32) return wrong(fmt::format("--min-votes {}: give 1 to 32", min_votes));
  if (!(depth_step >= 0.0 && depth_step < 1e12))
    return wrong(fmt::format("--depth-step {}: give a positive length, or auto", depth_step));
  if (step_pixels != 0.0 && !(step_pixels >= 0.05 && step_pixels <= 8.0))
    return wrong(fmt::format("--step-pixels {}: give a number from 0.05 to 8", step_pixels));
  if (support_tolerance < 0 || support_tolerance > 255)
    return wrong(fmt::format("--support-tolerance {}: give 0 to 255", support_tolerance));
  if (refinement < 1 || refinement > 32) return wrong(fmt::format("--refinement {}: give 1 to 32", refinement));
  return {};
}

}  // namespace quorum
