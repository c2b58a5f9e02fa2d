// The clocks by which a run measures itself.
#pragma once

namespace quorum {

/// Seconds since some moment in the past.
double wall_seconds();

/// CPU seconds of all threads of this process so far.
double process_cpu_seconds();

/// CPU seconds of the calling thread so far.
double thread_cpu_seconds();

/// CPU seconds of all threads so far but those that were declared to be in the background: what a stage takes while
/// files are read and written beside it.
double foreground_cpu_seconds();

/// While it lives, the thread that made it is in the background.
class BackgroundClock {
 public:
  BackgroundClock();
  ~BackgroundClock();
  BackgroundClock(const BackgroundClock&) = delete;
  BackgroundClock& operator=(const BackgroundClock&) = delete;
};

}  // namespace quorum
