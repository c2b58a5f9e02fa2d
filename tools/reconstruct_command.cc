// quorum reconstruct: photographs with cameras to depth maps and mesh.
#include "tools/run_pipeline.h"

namespace quorum {

int reconstruct_command(int argc, char** argv) {
  CommandLine line("Reconstruct a mesh from photographs with known cameras.", "reconstruct");
  RunArguments arguments;
  arguments.add_scene(line);
  arguments.add_output(line);
  arguments.add_restart(line);
  line.add_switch("--report", arguments.report, "Write report.html at the end, as `quorum report` does");
  add_run_options(line, arguments.options, kAllStages);
  return run_command(line, argc, argv, [&] { return run_pipeline(arguments); });
}

}  // namespace quorum
