#include "engine/core/clock.h"

#include <pthread.h>
#include <time.h>

#include <algorithm>
#include <mutex>
#include <vector>

namespace quorum {
namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

clockid_t clock_of_this_thread() {
  clockid_t clock = CLOCK_THREAD_CPUTIME_ID;
  pthread_getcpuclockid(pthread_self(), &clock);  // one that other threads can read, too
  return clock;
}

/// The background threads of this process.
struct Background {
  std::mutex mutex;  ///< guards what follows
  std::vector<clockid_t> running;
  double ended_seconds = 0.0;
};

Background& background() {
  static Background all;
  return all;
}

}  // namespace

double wall_seconds() { return seconds_of(CLOCK_MONOTONIC); }

double process_cpu_seconds() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

double thread_cpu_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

double foreground_cpu_seconds() {
  const std::lock_guard lock(background().mutex);
  double seconds = process_cpu_seconds() - background().ended_seconds;
  for (const clockid_t clock : background().running) seconds -= seconds_of(clock);
  return seconds;
}

BackgroundClock::BackgroundClock() {
  const std::lock_guard lock(background().mutex);
  background().running.push_back(clock_of_this_thread());
}

BackgroundClock::~BackgroundClock() {
  const std::lock_guard lock(background().mutex);
  std::erase(background().running, clock_of_this_thread());
  background().ended_seconds += thread_cpu_seconds();
}

}  // namespace quorum
