// How a run tells the user where it stands, and learns that it should stop.
#pragma once

#include <string_view>

namespace quorum {

class Progress {
 public:
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  virtual ~Progress() = default;

  /// A stage of `steps` steps begins; the one before it is done.
  virtual void stage(std::string_view /*name*/, int /*steps*/) {}
  /// One more step of the stage is done.
  virtual void step() {}
  /// Something the user should know, one line.
  virtual void note(std::string_view /*text*/) {}
  /// No more steps of the last stage will come.
  virtual void finish() {}
  /// True if the run should end before its next view.
  [[nodiscard]] virtual bool stop_requested() const { return false; }
};

}  // namespace quorum
