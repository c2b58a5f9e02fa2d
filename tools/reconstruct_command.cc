// quorum reconstruct: photographs with cameras to depth maps and mesh.
#include "tools/run_pipeline.h"

namespace quorum {

int reconstruct_command(int argc, char** argv) {
  CLI::App app("Reconstruct a mesh from photographs with known cameras.", "reconstruct");
  RunArguments arguments;
  arguments.add_scene(app);
  arguments.add_output(app);
  arguments.add_restart(app);
  app.add_flag("--report", arguments.report, "Write report.html at the end, as `quorum report` does");
  add_run_options(app, arguments.options, kAllStages);
  return run_command(app, argc, argv, [&] { return run_pipeline(arguments); });
}

}  // namespace quorum
