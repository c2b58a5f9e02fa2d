// quorum verify: whether a device gives the bytes that every device must give, or those of a run.
#include <fmt/format.h>

#include "engine/conformance/conformance.h"
#include "engine/conformance/verify_run.h"
#include "engine/io/scene_folder.h"
#include "engine/io/scratch_folder.h"
#include "host/run/open_backend.h"
#include "host/run/open_run.h"
#include "tools/add_options.h"
#include "tools/console_progress.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct VerifyArguments {
  std::filesystem::path output;
  std::filesystem::path scene;
  RunOptions options;
  bool quick = false;
  bool quiet = false;
};

Expected<void> verify_device(const VerifyArguments& arguments) {
  QUORUM_TRY(arguments.options.check());
  const ThreadLimit limit(arguments.options.threads);
  ConsoleProgress progress(arguments.quiet);
  QUORUM_ASSIGN(const auto backend, open_backend(arguments.options));
  print("{}\n", backend->description());
  std::string different;
  for (const ConformanceCase& conformance : conformance_cases()) {
    if (arguments.quick && !conformance.quick) continue;
    QUORUM_ASSIGN(const ScratchFolder folder, ScratchFolder::make());
    const auto found = run_conformance(conformance, *backend, folder.path(), progress);
    progress.finish();
    if (!found) return std::unexpected(found.error().within(conformance.name));
    const std::string_view stage = first_difference(conformance, *found);
    print("{:<14} {}\n", conformance.name, stage.empty() ? "equal" : fmt::format("{} differ first", stage));
    if (stage.empty()) continue;
    for (std::size_t i = 0; i < found->size(); ++i)
      print("  {:<12} {}, expected {}\n", kConformanceStages[i], (*found)[i], conformance.expected[i]);
    different += fmt::format("{}{}", different.empty() ? "" : ", ", conformance.name);
  }
  if (different.empty()) return {};
  return failure(ErrorKind::kDevice, fmt::format("{}: other bytes than docs/conformance.md on {}; report this with the "
                                                 "output of `quorum devices`",
                                                 different, backend->description()));
}

/// Makes the run again, beside it, and compares what comes of it.
Expected<void> verify_run(const VerifyArguments& arguments) {
  const Workspace workspace = Workspace::at(arguments.output);
  RunRequest request;
  QUORUM_ASSIGN(request.options, options_of_run(workspace, arguments.options));
  QUORUM_ASSIGN(const Scene scene, read_scene(arguments.scene, request.options.files));
  QUORUM_ASSIGN(const ScratchFolder folder, ScratchFolder::make());
  request.output = folder.path() / "again";
  request.command = "verify";
  constexpr RunSteps kSteps{.depth_maps = true, .certainties = true, .mesh = true};
  ConsoleProgress progress(arguments.quiet);
  std::string device;
  RunComparison found;
  const auto made = with_run(scene, request, progress, kSteps, [&](Run& run) -> Expected<void> {
    QUORUM_TRY(reconstruct(run, kSteps));
    device = run.backend.description();
    QUORUM_ASSIGN(found, compare_runs(scene, workspace, run.workspace));
    return {};
  });
  if (!made) return made;
  if (!found.stage.empty())
    return failure(found.stage.starts_with("photographs") ? ErrorKind::kInput : ErrorKind::kDevice,
                   fmt::format("{}: {} differ first from those of the run; {}",
                               (arguments.output / found.different).string(), found.stage,
                               found.stage.starts_with("photographs")
                                   ? "it was made of other files, or by other options, than these"
                                   : "compare `quorum verify --quick` on both devices"));
  QUORUM_TRY(record_verified(workspace, device));
  write_result(fmt::format("{}: equal, {} files, on {}\n", arguments.output.string(), found.files, device));
  return {};
}

Expected<void> verify(const VerifyArguments& arguments) {
  if (arguments.output.empty() && arguments.scene.empty()) return verify_device(arguments);
  if (arguments.output.empty() || arguments.scene.empty())
    return failure(ErrorKind::kUsage, "to verify a run, give its output folder and --scene with what it was made of");
  return verify_run(arguments);
}

}  // namespace

int verify_command(int argc, char** argv) {
  CommandLine line(
      "Reconstruct small scenes and compare every stage with the bytes that all devices must give; or make a "
      "run again and compare it with what it gave.",
      "verify");
  VerifyArguments arguments;
  line.add("output", arguments.output, "Output folder of a finished run; else the device is verified");
  line.add("--scene", arguments.scene, "Folder of the scene that the run was of");
  add_named_options(line, arguments.options, {"images", "masks", "roi"});
  add_run_options(line, arguments.options, {RunStage::kNone});
  line.add_switch("--quick", arguments.quick, "Leave out the scene of full size");
  line.add_switch("--quiet", arguments.quiet, "Print the results alone");
  return run_command(line, argc, argv, [&] { return verify(arguments); });
}

}  // namespace quorum
