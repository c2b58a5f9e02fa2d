// quorum reconstruct: photographs with cameras to depth maps and mesh.
#include "tools/run_arguments.h"

namespace quorum {

int reconstruct_command(int argc, char** argv) {
  CLI::App app("Reconstruct a mesh from photographs with known cameras.", "reconstruct");
  RunArguments arguments;
  arguments.add_scene_and_output(app);
  arguments.add_depth_options(app);
  arguments.add_fusion_options(app);
  arguments.add_device_and_output_options(app);
  return run_command(app, argc, argv, [&] { return run_pipeline(arguments, reconstruct_scene); });
}

}  // namespace quorum
