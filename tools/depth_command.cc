// quorum depth: the depth maps alone.
#include "tools/run_arguments.h"

namespace quorum {

int depth_command(int argc, char** argv) {
  CLI::App app("Compute the depth maps of a scene, without merging them.", "depth");
  RunArguments arguments;
  arguments.add_scene_and_output(app);
  arguments.add_depth_options(app);
  arguments.add_device_and_output_options(app);
  return run_command(app, argc, argv, [&] { return run_pipeline(arguments, compute_depth_maps); });
}

}  // namespace quorum
