#include "engine/pipeline/run_report.h"

#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <utility>

namespace quorum {
namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

StageTimer::StageTimer(RunReport& report, std::string name)
    : report_(report),
      name_(std::move(name)),
      wall_start_(seconds_of(CLOCK_MONOTONIC)),
      cpu_start_(seconds_of(CLOCK_PROCESS_CPUTIME_ID)) {}

StageTimer::~StageTimer() {
  auto stage = std::find_if(report_.stages.begin(), report_.stages.end(),
                            [&](const StageReport& candidate) { return candidate.name == name_; });
  if (stage == report_.stages.end()) stage = report_.stages.insert(stage, StageReport{name_, 0.0, 0.0});
  stage->wall_seconds += seconds_of(CLOCK_MONOTONIC) - wall_start_;
  stage->cpu_seconds += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu_start_;
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace quorum
