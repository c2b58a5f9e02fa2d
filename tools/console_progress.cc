#include "tools/console_progress.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <csignal>

namespace quorum {
namespace {

volatile std::sig_atomic_t stop_signal = 0;

void remember_signal(int signal) { stop_signal = signal; }

}  // namespace

ConsoleProgress::ConsoleProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {
  stop_signal = 0;
  std::signal(SIGTERM, remember_signal);
  std::signal(SIGINT, remember_signal);
}

ConsoleProgress::~ConsoleProgress() {
  finish();
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
}

void ConsoleProgress::stage(std::string_view name, int steps) {
  finish();
  name_ = name;
  steps_ = steps;
  done_ = 0;
  if (quiet_) return;
  if (terminal_)
    draw();
  else
    fmt::print(stderr, "{} ({})\n", name_, steps_);
}

void ConsoleProgress::step() {
  ++done_;
  if (quiet_) return;
  if (terminal_) draw();
  // Without a terminal: a line at each tenth of a long stage.
  else if (steps_ >= 20 && done_ * 10 / steps_ != (done_ - 1) * 10 / steps_)
    fmt::print(stderr, "{}: {} of {}\n", name_, done_, steps_);
}

void ConsoleProgress::note(std::string_view text) {
  if (quiet_) return;
  if (terminal_ && steps_ > 0) fmt::print(stderr, "\r\033[K");
  fmt::print(stderr, "{}\n", text);
  if (terminal_ && steps_ > 0) draw();
}

bool ConsoleProgress::stop_requested() const { return stop_signal != 0; }

void ConsoleProgress::finish() {
  if (!quiet_ && terminal_ && steps_ > 0) fmt::print(stderr, "\n");
  steps_ = 0;
}

void ConsoleProgress::draw() const {
  constexpr int kWidth = 30;
  const int filled = steps_ > 0 ? kWidth * done_ / steps_ : 0;
  fmt::print(stderr, "\r\033[K{:<22} [{:=<{}}{: <{}}] {}/{}", name_, "", filled, "", kWidth - filled, done_, steps_);
  std::fflush(stderr);
}

}  // namespace quorum
