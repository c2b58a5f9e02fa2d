// quorum report: a page that shows a run, from what it left in its output folder.
#include <fmt/format.h>

#include "engine/io/scene_folder.h"
#include "engine/pipeline/memory_budget.h"
#include "engine/report/report.h"
#include "host/run/open_backend.h"
#include "tools/add_options.h"
#include "tools/console_progress.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct ReportArguments {
  std::filesystem::path output;
  std::filesystem::path scene;
  bool quiet = false;
  RunOptions options;
};

Expected<void> write_page(const ReportArguments& arguments) {
  QUORUM_ASSIGN(const auto scene, read_scene(arguments.scene, arguments.options.files));
  const ThreadLimit limit(arguments.options.threads);
  const Workspace workspace = Workspace::at(arguments.output);
  ConsoleProgress progress(arguments.quiet);
  for (const std::string& note : scene.notes) progress.note(note);
  const auto written = write_report(scene, workspace, MemoryBudget(arguments.options.memory_bytes), progress);
  progress.finish();
  if (!written) return written;
  write_result(fmt::format("{}\n", (arguments.output / "report.html").string()));
  return {};
}

}  // namespace

int report_command(int argc, char** argv) {
  CommandLine line(
      "Write OUT/report.html: the mesh, how sure each place of it is, what is missing, and the photographs beside it.",
      "report");
  ReportArguments arguments;
  line.add("output", arguments.output, "Output folder of a finished run").required();
  line.add("--scene", arguments.scene, "Folder of the scene that the run was of").required();
  add_named_options(line, arguments.options, {"format", "images", "model", "max-image-size", "threads", "memory"});
  line.add_switch("--quiet", arguments.quiet, "Print nothing but errors and the result");
  return run_command(line, argc, argv, [&] { return write_page(arguments); });
}

}  // namespace quorum
