// Progress for people: a bar on a terminal, plain lines elsewhere; and the signals that ask to stop.
#pragma once

#include <string>

#include "engine/pipeline/progress.h"

namespace quorum {

/// Prints on standard error. While it lives, SIGTERM and SIGINT ask the run to stop.
class ConsoleProgress : public Progress {
 public:
  explicit ConsoleProgress(bool quiet);
  ~ConsoleProgress() override;

  void stage(std::string_view name, int steps) override;
  void step() override;
  void note(std::string_view text) override;
  [[nodiscard]] bool stop_requested() const override;
  /// Ends the last stage's line.
  void finish();

 private:
  void draw() const;

  bool quiet_;
  bool terminal_;
  std::string name_;
  int steps_ = 0;
  int done_ = 0;
};

}  // namespace quorum
