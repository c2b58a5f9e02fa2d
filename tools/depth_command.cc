// quorum depth: the depth maps alone.
#include "tools/run_pipeline.h"

namespace quorum {

int depth_command(int argc, char** argv) {
  CommandLine line("Compute the depth maps of a scene, without merging them.", "depth");
  RunArguments arguments;
  arguments.add_scene(line);
  arguments.add_output(line);
  arguments.add_restart(line);
  add_run_options(
      line, arguments.options,
      {RunStage::kScene, RunStage::kDepth, RunStage::kExtras, RunStage::kFiles, RunStage::kNone, RunStage::kShards});
  return run_command(line, argc, argv, [&] { return run_pipeline(arguments, {.certainties = false, .mesh = false}); });
}

}  // namespace quorum
