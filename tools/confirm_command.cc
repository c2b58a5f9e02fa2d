// quorum confirm: the certainty of depth maps that `quorum depth` left in the output folder.
#include "tools/run_pipeline.h"

namespace quorum {

int confirm_command(int argc, char** argv) {
  CommandLine line("Give the depth maps in the output folder a certainty, from what they say of each other.",
                   "confirm");
  RunArguments arguments;
  arguments.add_scene(line);
  arguments.add_output(line);
  arguments.takes_depth_options = true;
  add_run_options(line, arguments.options,
                  {RunStage::kScene, RunStage::kConfirm, RunStage::kFiles, RunStage::kNone, RunStage::kShards});
  return run_command(line, argc, argv, [&] { return run_pipeline(arguments, {.depth_maps = false, .mesh = false}); });
}

}  // namespace quorum
