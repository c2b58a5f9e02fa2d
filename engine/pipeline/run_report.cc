#include "engine/pipeline/run_report.h"

#include <algorithm>
#include <utility>

#include "engine/core/clock.h"

namespace quorum {

void add_stage(RunReport& report, const StageReport& time) {
  auto stage = std::ranges::find(report.stages, time.name, &StageReport::name);
  if (stage == report.stages.end()) stage = report.stages.insert(stage, StageReport{time.name, 0.0, 0.0});
  stage->wall_seconds += time.wall_seconds;
  stage->cpu_seconds += time.cpu_seconds;
}

StageTimer::StageTimer(RunReport& report, const char* name)
    : report_(report), name_(name), wall_start_(wall_seconds()), cpu_start_(foreground_cpu_seconds()) {}

StageTimer::~StageTimer() {
  if (name_ == nullptr) return;
  add_stage(report_, {name_, wall_seconds() - wall_start_, foreground_cpu_seconds() - cpu_start_});
}

}  // namespace quorum
