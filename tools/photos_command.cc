// quorum photos: plain photographs to depth maps and mesh. COLMAP, where it is installed, finds the cameras.
#include "tools/console_progress.h"
#include "tools/run_colmap.h"
#include "tools/run_pipeline.h"

namespace quorum {

int photos_command(int argc, char** argv) {
  CommandLine line("Reconstruct a mesh from plain photographs; the installed colmap finds their cameras.", "photos");
  RunArguments arguments;
  std::filesystem::path photos;
  arguments.options.files.format = SceneFormat::kColmap;
  arguments.options.files.max_image_size = 2000;
  line.add("photos", photos, "Folder with the photographs").required();
  arguments.add_output(line);
  arguments.add_restart(line);
  add_run_options(line, arguments.options, kAllStages, {"format", "images", "model"});
  return run_command(line, argc, argv, [&]() -> Expected<void> {
    QUORUM_TRY(Workspace::check_ours(arguments.output));  // before colmap works for hours
    arguments.scene = arguments.output / "cameras" / "dense";
    {
      ConsoleProgress progress(arguments.progress_form());
      auto found = run_colmap(photos, arguments.output / "cameras", arguments.options.files.max_image_size, progress);
      if (!found) return found;
    }
    return run_pipeline(arguments);
  });
}

}  // namespace quorum
