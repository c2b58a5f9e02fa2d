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
  return run_command(app, argc, argv, [&] {
    return run_pipeline(arguments, [](const Scene& scene, const ReconstructOptions& options, Backend& backend,
                                      const Workspace& workspace, Progress& progress, RunReport& report) {
      auto done = compute_depth_maps(scene, options, backend, workspace, progress, report);
      return done ? fuse_depth_maps(scene, options, backend, workspace, progress, report) : done;
    });
  });
}

}  // namespace quorum
