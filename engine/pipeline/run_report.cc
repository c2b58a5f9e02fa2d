#include "engine/pipeline/run_report.h"

#include <algorithm>
#include <utility>

#include "engine/core/clock.h"

namespace quorum {

StageTimer::StageTimer(RunReport& report, std::string name)
    : report_(report), name_(std::move(name)), wall_start_(wall_seconds()), cpu_start_(process_cpu_seconds()) {}

StageTimer::~StageTimer() {
  auto stage = std::find_if(report_.stages.begin(), report_.stages.end(),
                            [&](const StageReport& candidate) { return candidate.name == name_; });
  if (stage == report_.stages.end()) stage = report_.stages.insert(stage, StageReport{name_, 0.0, 0.0});
  stage->wall_seconds += wall_seconds() - wall_start_;
  stage->cpu_seconds += process_cpu_seconds() - cpu_start_;
}

}  // namespace quorum
