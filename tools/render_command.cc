// quorum render: a picture of a mesh or a cloud from one of the scene's cameras.
#include <fmt/format.h>

#include <algorithm>

#include "engine/evaluate/color_by_error.h"
#include "engine/io/image_file.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "engine/mesh/render_points.h"
#include "tools/run_arguments.h"

namespace quorum {
namespace {

struct RenderArguments {
  std::filesystem::path mesh;
  std::filesystem::path scene;
  SceneOptions files;
  std::string view;
  std::filesystem::path output;
  std::string shading = "shaded";
  std::filesystem::path truth;
  std::string full_error = "1mm";
};

/// The mesh as it is, or in the colors of its error.
Expected<Mesh> read_mesh(const RenderArguments& arguments) {
  auto mesh = read_ply(arguments.mesh);
  if (!mesh || arguments.shading != "error") return mesh;
  if (arguments.truth.empty())
    return failure(ErrorKind::kUsage, "--shading error: give the true surface with --truth FILE");
  const auto full_error = parse_length("--full-error", arguments.full_error);
  if (!full_error) return std::unexpected(full_error.error());
  const auto truth = read_ply(arguments.truth);
  if (!truth) return std::unexpected(truth.error());
  return color_by_error(std::move(*mesh), *truth, *full_error);
}

Expected<void> render_file(const RenderArguments& arguments) {
  using Shading = RenderOptions::Shading;
  RenderOptions options;
  options.shading = arguments.shading == "color"        ? Shading::kColor
                    : arguments.shading == "error"      ? Shading::kColor
                    : arguments.shading == "confidence" ? Shading::kConfidence
                    : arguments.shading == "normal"     ? Shading::kNormal
                                                        : Shading::kShaded;
  const auto scene = read_scene(arguments.scene, arguments.files);
  if (!scene) return std::unexpected(scene.error());
  const auto view = std::find_if(scene->views.begin(), scene->views.end(),
                                 [&](const View& candidate) { return candidate.name == arguments.view; });
  if (view == scene->views.end())
    return failure(ErrorKind::kUsage, fmt::format("--view {}: no such view; there are {} to {}", arguments.view,
                                                  scene->views.front().name, scene->views.back().name));
  const auto mesh = read_mesh(arguments);
  if (!mesh) return std::unexpected(mesh.error());
  const auto render = mesh->triangles.empty() ? render_points : render_mesh;
  const auto image = render(*mesh, view->camera, view->width, view->height, options);
  if (!image) return std::unexpected(image.error());
  return write_png(arguments.output, *image);
}

}  // namespace

int render_command(int argc, char** argv) {
  CLI::App app("Draw a mesh, or a cloud of points, as one of the scene's cameras sees it.", "render");
  RenderArguments arguments;
  app.add_option("mesh", arguments.mesh, "PLY file")->required();
  app.add_option("--scene", arguments.scene, "Folder of the scene")->required();
  add_format_options(app, arguments.files);
  app.add_option("--view", arguments.view, "Name of the view: its image file without extension")->required();
  app.add_option("-o,--output", arguments.output, "PNG file")->required();
  app.add_option("--shading", arguments.shading, "What to show")
      ->check(CLI::IsMember({"shaded", "color", "confidence", "normal", "error"}))
      ->capture_default_str();
  app.add_option("--truth", arguments.truth, "PLY file of the true surface, for --shading error");
  app.add_option("--full-error", arguments.full_error, "Distance from the truth that is drawn red; 0 is blue")
      ->capture_default_str();
  return run_command(app, argc, argv, [&] { return render_file(arguments); });
}

}  // namespace quorum
