// quorum photos: plain photographs to depth maps and mesh. COLMAP, where it is installed, finds the cameras.
#include "tools/console_progress.h"
#include "tools/run_arguments.h"
#include "tools/run_colmap.h"

namespace quorum {

int photos_command(int argc, char** argv) {
  CLI::App app("Reconstruct a mesh from plain photographs; the installed colmap finds their cameras.", "photos");
  RunArguments arguments;
  std::filesystem::path photos;
  arguments.files.format = SceneFormat::kColmap;
  arguments.files.max_image_size = 2000;
  app.add_option("photos", photos, "Folder with the photographs")->required();
  arguments.add_output_options(app);
  app.add_option("--max-image-size", arguments.files.max_image_size, "Largest side of the photographs; 0: theirs")
      ->capture_default_str();
  arguments.add_depth_options(app);
  arguments.add_fusion_options(app);
  arguments.add_device_and_output_options(app);
  return run_command(app, argc, argv, [&]() -> Expected<void> {
    arguments.scene = arguments.output / "cameras" / "dense";
    {
      ConsoleProgress progress(arguments.quiet);
      auto found = run_colmap(photos, arguments.output / "cameras", arguments.files.max_image_size, progress);
      if (!found) return found;
    }
    return run_pipeline(arguments, reconstruct_scene);
  });
}

}  // namespace quorum
