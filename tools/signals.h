// The signals that end the program, or don't.
#pragma once

namespace quorum {

/// From here on SIGINT, SIGTERM and SIGHUP end the program at once, with exit code 128 + signal and without temporary
/// files, and writes that SIGPIPE or SIGXFSZ would answer fail instead. abort() ends it with a line and code 5
/// within a library that reads images, else 1. SIGHUP stays ignored if it is (nohup).
void handle_signals();

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is kept for stop_signal(), and so are more of SIGTERM and
/// SIGHUP; a SIGINT after another signal ends the program at once.
class StopSignals {
 public:
  /// quiet: SIGINT is not answered by a message. terminal: an unfinished line stands there.
  StopSignals(bool quiet, bool terminal);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
};

/// The first signal that asked to stop, or 0.
int stop_signal();

}  // namespace quorum
