// quorum report: a page that shows a run, from what it left in its output folder.
#include <fmt/format.h>

#include "engine/io/scene_folder.h"
#include "engine/report/report.h"
#include "tools/add_options.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct ReportArguments {
  std::filesystem::path output;
  std::filesystem::path scene;
  RunOptions options;
};

Expected<void> write_page(const ReportArguments& arguments) {
  QUORUM_ASSIGN(const auto scene, read_scene(arguments.scene, arguments.options.files));
  const Workspace workspace = Workspace::at(arguments.output);
  QUORUM_TRY(write_report(scene, workspace));
  write_result(fmt::format("{}\n", (arguments.output / "report.html").string()));
  return {};
}

}  // namespace

int report_command(int argc, char** argv) {
  CLI::App app(
      "Write OUT/report.html: the mesh, how sure each place of it is, what is missing, and the photographs beside it.",
      "report");
  ReportArguments arguments;
  app.add_option("output", arguments.output, "Output folder of a finished run")->required();
  app.add_option("--scene", arguments.scene, "Folder of the scene that the run was of")->required();
  add_named_options(app, arguments.options, {"format", "images", "model", "max-image-size"});
  return run_command(app, argc, argv, [&] { return write_page(arguments); });
}

}  // namespace quorum
