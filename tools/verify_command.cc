// quorum verify: whether a device gives the bytes that every device must give.
#include <fmt/format.h>

#include "engine/conformance/conformance.h"
#include "engine/io/scratch_folder.h"
#include "host/run/open_backend.h"
#include "tools/add_options.h"
#include "tools/console_progress.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct VerifyArguments {
  RunOptions options;
  bool quick = false;
  bool quiet = false;
};

Expected<void> verify(const VerifyArguments& arguments) {
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

}  // namespace

int verify_command(int argc, char** argv) {
  CommandLine line("Reconstruct small scenes and compare every stage with the bytes that all devices must give.",
                   "verify");
  VerifyArguments arguments;
  add_run_options(line, arguments.options, {RunStage::kNone});
  line.add_switch("--quick", arguments.quick, "Leave out the scene of full size");
  line.add_switch("--quiet", arguments.quiet, "Print the results alone");
  return run_command(line, argc, argv, [&] { return verify(arguments); });
}

}  // namespace quorum
