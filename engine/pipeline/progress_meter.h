// How far a run is, how fast it goes and when it will end, from what a Progress is told.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quorum {

/// A stage of a run under its name, and its share of the run's time, in any unit.
struct StageWeight {
  std::string_view name;
  double weight = 0.0;
};

/// Of a whole run of many views, in order. Measured with defaults (docs/performance.md); others shift the share that is
/// told of the run, not that of the stage.
const std::vector<StageWeight>& run_stage_weights();

/// Times are seconds of one clock.
class ProgressMeter {
 public:
  /// expected: the stages that will come, in order; some may be skipped. Others count nothing for the run.
  explicit ProgressMeter(std::vector<StageWeight> expected) : expected_(std::move(expected)) {}

  void stage(std::string_view name, int steps, double now);
  void step(double now);
  /// Until the next stage begins there are no steps.
  void end_stage();

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] int done() const { return done_; }
  [[nodiscard]] int steps() const { return steps_; }
  /// 0 to 100, of the stage and of the whole run.
  [[nodiscard]] double percent() const { return steps_ > 0 ? 100.0 * done_ / steps_ : 0.0; }
  [[nodiscard]] double run_percent() const;
  /// Steps a second, over the stage so far; 0 before the first.
  [[nodiscard]] double rate() const;
  /// Until the stage is done, and the run; empty before the first step.
  [[nodiscard]] std::optional<double> seconds_left() const;
  [[nodiscard]] std::optional<double> run_seconds_left() const;

 private:
  std::vector<StageWeight> expected_;
  std::string name_;
  double before_ = 0.0;  // weights of the stages that are done
  double weight_ = 0.0;  // of this one
  int steps_ = 0;
  int done_ = 0;
  std::optional<double> run_began_;
  double began_ = 0.0;
  double last_step_ = 0.0;
};

/// "12 s", "5 min", "2.5 h".
std::string duration_text(double seconds);

}  // namespace quorum
