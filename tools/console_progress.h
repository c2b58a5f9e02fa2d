// Progress on standard error: for people a bar on a terminal, lines elsewhere; for programs a JSON object a line; and
// the signals that ask to stop.
#pragma once

#include <string>
#include <vector>

#include "engine/pipeline/progress.h"
#include "engine/pipeline/progress_meter.h"
#include "tools/signals.h"

namespace quorum {

enum class ProgressForm {
  kText,
  kJson,  ///< docs/formats.md has the events
  kNone,
};

/// While it lives, signals ask the run to stop (StopSignals).
class ConsoleProgress : public Progress {
 public:
  explicit ConsoleProgress(bool quiet) : ConsoleProgress(quiet ? ProgressForm::kNone : ProgressForm::kText) {}
  /// expected: the stages of the run, for its percentage.
  explicit ConsoleProgress(ProgressForm form, std::vector<StageWeight> expected = {});
  ~ConsoleProgress() override;

  void stage(std::string_view name, int steps) override;
  void step() override;
  void note(std::string_view text) override;
  [[nodiscard]] bool stop_requested() const override;
  /// Ends the last stage's line.
  void finish() override;

 private:
  /// A line, or an event, of where the run is. event: "stage" or "step".
  void tell_state(const char* event);
  void draw() const;

  ProgressForm form_;
  bool terminal_;
  StopSignals signals_;
  ProgressMeter meter_;
  double last_line_ = 0.0;
};

}  // namespace quorum
