// quorum fuse: the mesh from depth maps that `quorum depth` left in the output folder.
#include "tools/run_pipeline.h"

namespace quorum {

int fuse_command(int argc, char** argv) {
  CommandLine line("Merge the depth maps in the output folder into a mesh.", "fuse");
  RunArguments arguments;
  arguments.add_scene(line);
  arguments.add_output(line);
  arguments.takes_depth_options = true;
  add_run_options(line, arguments.options,
                  {RunStage::kScene, RunStage::kConfirm, RunStage::kFusion, RunStage::kClean, RunStage::kExtras,
                   RunStage::kNone, RunStage::kShards});
  add_named_options(line, arguments.options, {"mask-below"});  // with fill-holes, what is dark is background
  return run_command(line, argc, argv, [&] { return run_pipeline(arguments, {.depth_maps = false}); });
}

}  // namespace quorum
