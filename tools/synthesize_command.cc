// quorum synthesize: a scene of known shape, as a Middlebury folder with its exact surface.
#include <fmt/format.h>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/middlebury.h"
#include "engine/io/ply.h"
#include "engine/synthetic/temple.h"
#include "tools/command.h"

namespace quorum {
namespace {

constexpr double kSurfaceEdge = 0.001;  // of the triangles of gt.ply, meters

Expected<void> synthesize(const std::filesystem::path& folder, const TempleOptions& options) {
  if (auto checked = options.check(); !checked) return checked;
  if (auto made = make_folder(folder); !made) return made;
  const Scene scene = make_temple_scene(options);
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    const auto path = folder / scene.views[static_cast<std::size_t>(view)].image_path;
    if (auto written = write_png(path, render_temple(scene, view, options)); !written) return written;
  }
  if (auto written = write_ply(folder / "gt.ply", temple_surface(kSurfaceEdge)); !written) return written;
  return write_middlebury(folder, "temple", scene);
}

}  // namespace

int synthesize_command(int argc, char** argv) {
  CLI::App app("Render a small stone temple from known cameras, with its exact surface gt.ply.", "synthesize");
  std::filesystem::path folder;
  TempleOptions options;
  std::string path = "ring";
  app.add_option("output", folder, "Folder for the scene; made if missing")->required();
  app.add_option("--views", options.views, "Photographs to take")->capture_default_str();
  app.add_option("--cameras", path, "Where the cameras stand")
      ->check(CLI::IsMember({"ring", "hemisphere"}))
      ->capture_default_str();
  app.add_option("--width", options.width, "Width of the photographs, pixels; the height is 3/4 of it")
      ->capture_default_str();
  app.add_option("--noise", options.noise, "Standard deviation of the sensor noise, gray levels")
      ->capture_default_str();
  app.add_option("--texture", options.texture, "Strength of the stone's texture; 0: plain plaster")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Same seed, same bytes")->capture_default_str();
  return run_command(app, argc, argv, [&] {
    options.path = path == "hemisphere" ? CameraPath::kHemisphere : CameraPath::kRing;
    return synthesize(folder, options);
  });
}

}  // namespace quorum
