// quorum plan: what a run will take, before it begins.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <optional>

#include "engine/core/parse_number.h"
#include "engine/pipeline/plan.h"
#include "host/run/open_backend.h"
#include "tools/messages.h"
#include "tools/run_pipeline.h"

namespace quorum {
namespace {

/// "90s", "30min", "2h", "1.5d"; seconds. Empty if it is none, or not above 0.
std::optional<double> parse_time(std::string_view text) {
  constexpr std::pair<std::string_view, double> kUnits[] = {{"min", 60.0}, {"s", 1.0}, {"h", 3600.0}, {"d", 86400.0}};
  for (const auto& [unit, seconds] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto number = parse_number<double>(text.substr(0, text.size() - unit.size()));
    return number && *number > 0 ? std::optional(*number * seconds) : std::nullopt;
  }
  return std::nullopt;
}

std::string time_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string size_text(std::uint64_t bytes) {
  const double mib = static_cast<double>(bytes) / (1 << 20);
  return mib < 4096 ? fmt::format("{:.0f} MiB", mib) : fmt::format("{:.1f} GiB", mib / 1024);
}

void print_plan(const Plan& plan, int threads, double most_seconds) {
  const auto line = [](const char* what, const std::string& text) { print("{:<12} {}\n", what, text); };
  line("views", plan.left_out == 0 ? fmt::format("{}", plan.views)
                                   : fmt::format("{}, {} more have too few neighbors", plan.views, plan.left_out));
  if (plan.views > kMaxIntegratedViews)
    line("", fmt::format("one volume takes {}: cut the scene into parts before the fusion", kMaxIntegratedViews));
  line("pixels", fmt::format("{:.1f} million, {:.0f} % of them toward the box, {:.0f} depth samples each",
                             static_cast<double>(plan.pixels) / 1e6, 100 * plan.swept_share, plan.samples));
  line("volume", fmt::format("voxels of {:.4g}, about {} blocks, {:.1f} million triangles", plan.grid.voxel_size,
                             plan.blocks, static_cast<double>(plan.triangles) / 1e6));
  line("memory",
       fmt::format("{} at least (--memory), {} at most", size_text(plan.least_memory), size_text(plan.full_memory)));
  line("disk", size_text(plan.disk));
  line("CPU time", fmt::format("{}: depth {}, confirm {}, fuse {}, join {}", time_text(plan.cpu_seconds()),
                               time_text(plan.depth_seconds), time_text(plan.confirm_seconds),
                               time_text(plan.collect_seconds + plan.merge_seconds), time_text(plan.join_seconds)));
  line("time", fmt::format("{} with {} threads", time_text(plan.seconds(1, threads)), threads));
  if (most_seconds <= 0) return;
  const int shards = plan.shards(most_seconds, threads);
  line("shards",
       shards == 0
           ? fmt::format("no number of them takes {}; give each more threads, or fewer pixels", time_text(most_seconds))
           : fmt::format("{} with {} threads each take {}", shards, threads, time_text(plan.seconds(shards, threads))));
}

}  // namespace

int plan_command(int argc, char** argv) {
  CommandLine line("Tell what a run on the CPU will take: sizes, memory, disk, time, and shards for a given time.",
                   "plan");
  RunArguments arguments;
  std::string time;
  arguments.add_scene(line);
  line.add("--time", time, "Time that the run may take, such as 30min, 2h or 1d: tells how many shards it needs");
  add_run_options(line, arguments.options,
                  {RunStage::kScene, RunStage::kDepth, RunStage::kConfirm, RunStage::kFusion, RunStage::kNone},
                  {"device", "memory"});
  return run_command(line, argc, argv, [&]() -> Expected<void> {
    QUORUM_TRY(arguments.options.check());
    const auto seconds = parse_time(time);
    if (!time.empty() && !seconds)
      return failure(ErrorKind::kUsage, fmt::format("--time {}: give a time such as 90s, 30min, 2h or 1d", time));
    const ThreadLimit limit(arguments.options.threads);
    QUORUM_ASSIGN(const Scene scene, read_scene(arguments.scene, arguments.options.files));
    for (const std::string& note : scene.notes) tell(note);
    QUORUM_ASSIGN(const Plan plan, make_plan(scene, arguments.options));
    const auto threads =
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    print_plan(plan, threads, seconds.value_or(0));
    return {};
  });
}

}  // namespace quorum
