// quorum depth: the depth maps alone.
#include "tools/run_pipeline.h"

namespace quorum {

int depth_command(int argc, char** argv) {
  CLI::App app("Compute the depth maps of a scene, without merging them.", "depth");
  RunArguments arguments;
  arguments.add_scene(app);
  arguments.add_output(app);
  arguments.add_restart(app);
  add_run_options(
      app, arguments.options,
      {RunStage::kScene, RunStage::kDepth, RunStage::kExtras, RunStage::kFiles, RunStage::kNone, RunStage::kShards});
  return run_command(app, argc, argv, [&] { return run_pipeline(arguments, {.certainties = false, .mesh = false}); });
}

}  // namespace quorum
