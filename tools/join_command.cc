// quorum join: the mesh from the parts that all shards of `quorum fuse` left in the output folder.
#include "tools/run_pipeline.h"

namespace quorum {

int join_command(int argc, char** argv) {
  CommandLine line("Make the mesh of the parts that the shards of `quorum fuse` left in the output folder.", "join");
  RunArguments arguments;
  arguments.add_scene(line);
  arguments.add_output(line);
  arguments.takes_depth_options = arguments.takes_part_options = true;
  add_run_options(line, arguments.options, {RunStage::kScene, RunStage::kClean, RunStage::kExtras, RunStage::kNone});
  return run_command(line, argc, argv, [&] {
    return run_pipeline(arguments, {.depth_maps = false, .certainties = false, .joins = true});
  });
}

}  // namespace quorum
