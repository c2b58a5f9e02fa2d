#include "engine/pipeline/progress_meter.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace quorum {

const std::vector<StageWeight>& run_stage_weights() {
  static const std::vector<StageWeight> kWeights = {{"computing depth maps", 86.0},
                                                    {"confirming depths", 3.0},
                                                    {"finding voxel blocks", 3.0},
                                                    {"merging depth maps", 6.0},
                                                    {"extracting the mesh", 2.0}};
  return kWeights;
}

void ProgressMeter::stage(std::string_view name, int steps, double now) {
  if (!run_began_ && steps > 0) run_began_ = now;
  const bool again = name == name_;
  double before = 0.0;
  weight_ = 0.0;
  for (const StageWeight& expected : expected_) {
    if (expected.name == name) {
      weight_ = expected.weight;
      before_ = before;
      break;
    }
    before += expected.weight;
  }
  // A stage that comes again, such as the next slab's, leaves the run where it was.
  if (again) before_ += std::exchange(weight_, 0.0);
  name_ = name;
  steps_ = steps;
  done_ = 0;
  began_ = last_step_ = now;
}

void ProgressMeter::end_stage() {
  before_ += percent() / 100.0 * std::exchange(weight_, 0.0);
  steps_ = done_ = 0;
}

void ProgressMeter::step(double now) {
  ++done_;
  last_step_ = now;
}

double ProgressMeter::run_percent() const {
  double all = 0.0;
  for (const StageWeight& expected : expected_) all += expected.weight;
  return all > 0 ? std::min(100.0, (100.0 * before_ + percent() * weight_) / all) : 0.0;
}

double ProgressMeter::rate() const { return last_step_ > began_ ? done_ / (last_step_ - began_) : 0.0; }

std::optional<double> ProgressMeter::seconds_left() const {
  if (rate() <= 0) return std::nullopt;
  return std::max(0, steps_ - done_) / rate();
}

std::optional<double> ProgressMeter::run_seconds_left() const {
  const double percent = run_percent();
  if (!run_began_ || percent <= 0 || last_step_ <= *run_began_) return std::nullopt;
  return (last_step_ - *run_began_) * (100.0 - percent) / percent;
}

std::string duration_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace quorum
