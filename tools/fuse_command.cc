// quorum fuse: the mesh from depth maps that `quorum depth` left in the output folder.
#include "tools/run_arguments.h"

namespace quorum {

int fuse_command(int argc, char** argv) {
  CLI::App app("Merge the depth maps in the output folder into a mesh.", "fuse");
  RunArguments arguments;
  arguments.add_scene_and_output(app);
  arguments.add_fuse_options(app);
  arguments.add_device_and_output_options(app);
  return run_command(app, argc, argv, [&] { return run_pipeline(arguments, fuse_depth_maps); });
}

}  // namespace quorum
