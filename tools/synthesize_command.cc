// quorum synthesize: a scene of known shape, as a Middlebury folder with its exact surface.
#include "engine/pipeline/synthesize.h"
#include "tools/command.h"

namespace quorum {

int synthesize_command(int argc, char** argv) {
  CLI::App app("Render a small stone temple from known cameras, with its exact surface gt.ply.", "synthesize");
  std::filesystem::path folder;
  TempleOptions options;
  std::string path = "ring";
  std::string lights = "fixed";
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
  app.add_option("--gloss", options.gloss, "Strength of highlights, 0 to 1")->capture_default_str();
  app.add_option("--lights", lights, "fixed; or per-view: other places and strengths for each photograph")
      ->check(CLI::IsMember({"fixed", "per-view"}))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Same seed, same bytes")->capture_default_str();
  return run_command(app, argc, argv, [&] {
    options.path = path == "hemisphere" ? CameraPath::kHemisphere : CameraPath::kRing;
    options.lighting = lights == "per-view" ? Lighting::kPerView : Lighting::kFixed;
    return synthesize_temple(folder, options);
  });
}

}  // namespace quorum
