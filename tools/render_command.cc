// quorum render: a picture of a mesh or a cloud from one of the scene's cameras.
#include <fmt/format.h>

#include <algorithm>

#include "engine/core/did_you_mean.h"
#include "engine/evaluate/color_by_error.h"
#include "engine/io/file.h"
#include "engine/io/glb.h"
#include "engine/io/image_store.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "engine/io/write_image.h"
#include "engine/render/compare_pictures.h"
#include "engine/render/render_points.h"
#include "engine/render/turntable.h"
#include "tools/add_options.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct RenderArguments {
  std::filesystem::path mesh;
  std::filesystem::path scene;
  RunOptions options;
  std::string view;
  std::filesystem::path output;
  std::string shading = "shaded";
  std::filesystem::path truth;
  std::string full_error = "1mm";
  bool compares = false;
  int turntable = 0;  ///< pictures on the way around; 0: one, from the view
};

Expected<TexturedMesh> read_any_mesh(const std::filesystem::path& path, const Scene& scene) {
  if (path.extension() == ".glb") return read_glb(path, scene.offset);
  TexturedMesh mesh;
  QUORUM_ASSIGN(mesh.mesh, read_ply(path, scene.offset));
  return mesh;
}

/// The mesh as it is, or in the colors of its error, in the scene's frame.
Expected<TexturedMesh> read_mesh(const RenderArguments& arguments, const Scene& scene) {
  auto mesh = read_any_mesh(arguments.mesh, scene);
  if (!mesh || arguments.shading != "error") return mesh;
  if (arguments.truth.empty())
    return failure(ErrorKind::kUsage, "--shading error: give the true surface with --truth FILE");
  const auto full_error = parse_length(arguments.full_error);
  if (!full_error || !(*full_error > 0))
    return failure(ErrorKind::kUsage, fmt::format("--full-error {}: give a length such as 1mm", arguments.full_error));
  QUORUM_ASSIGN(const auto truth, read_ply(arguments.truth, scene.offset));
  QUORUM_ASSIGN(mesh->mesh, color_by_error(std::move(mesh->mesh), truth, *full_error));
  mesh->pages.clear();
  return mesh;
}

/// Tells how like the picture is to the photograph where it shows the mesh and no mask leaves it out.
Expected<void> compare(const Scene& scene, double mask_below, int view, const ColorImage& picture, Mask where) {
  ImageStore images(scene, 0, mask_below);
  QUORUM_ASSIGN(const auto photograph, images.image(view));
  QUORUM_ASSIGN(const auto mask, images.mask(view));
  for (std::size_t pixel = 0; pixel < mask->values.size(); ++pixel) where.values[pixel] &= mask->values[pixel];
  const PictureLikeness likeness = compare_pictures(picture, *photograph, where);
  write_result(
      fmt::format("PSNR {:.2f} dB, SSIM {:.4f} on {} pixels\n", likeness.psnr, likeness.ssim, likeness.pixels));
  return {};
}

/// whole: as of render_textured; a cloud has none.
Expected<ColorImage> draw(const TexturedMesh& mesh, const View& view, const Camera& camera,
                          const RenderOptions& options, Mask* whole = nullptr) {
  if (mesh.mesh.triangles.empty()) return render_points(mesh.mesh, camera, view.width, view.height, options);
  return render_textured(mesh, camera, view.width, view.height, options, whole);
}

std::filesystem::path picture_around(const RenderArguments& arguments, int number) {
  return arguments.output / fmt::format("{:04}.png", number);
}

/// Pictures from all sides, from the view on, in the folder of the output.
Expected<void> draw_around(const RenderArguments& arguments, const Scene& scene, const View& view,
                           const TexturedMesh& mesh, const RenderOptions& options) {
  std::vector<Camera> cameras;
  for (const View& any : scene.views) cameras.push_back(any.camera);
  Eigen::Vector3d up = mean_up(cameras);
  if (up.isZero()) up = mean_up(std::span(&view.camera, 1));
  QUORUM_TRY(make_folder(arguments.output));
  int number = 0;
  for (const Camera& camera : turntable(view.camera, middle_of(mesh.mesh), up, arguments.turntable)) {
    QUORUM_ASSIGN(const auto image, draw(mesh, view, camera, options));
    QUORUM_TRY(write_image(picture_around(arguments, number++), image));
  }
  return {};
}

Expected<void> render_file(const RenderArguments& arguments) {
  using Shading = RenderOptions::Shading;
  RenderOptions options;
  options.shading = arguments.shading == "color"        ? Shading::kColor
                    : arguments.shading == "error"      ? Shading::kColor
                    : arguments.shading == "confidence" ? Shading::kConfidence
                    : arguments.shading == "normal"     ? Shading::kNormal
                                                        : Shading::kShaded;
  if (arguments.turntable > 0 && arguments.compares)
    return failure(ErrorKind::kUsage, "--compare: the views around have no photographs; leave out --turntable");
  QUORUM_ASSIGN(const auto scene, read_scene(arguments.scene, arguments.options.files));
  std::vector<std::filesystem::path> inputs = {arguments.mesh, arguments.truth};
  for (const View& view : scene.views) inputs.insert(inputs.end(), {view.image_path, view.mask_path});
  QUORUM_TRY(check_not_input(arguments.output, inputs));
  for (int number = 0; number < arguments.turntable; ++number)
    QUORUM_TRY(check_not_input(picture_around(arguments, number), inputs));
  const auto is_view = [&](const View& view) {
    return view.name == arguments.view || view.image_name == arguments.view ||
           view.image_path.filename() == arguments.view || view.image_path.stem() == arguments.view;
  };
  const auto view = std::ranges::find_if(scene.views, is_view);
  if (view == scene.views.end()) {
    std::vector<std::string> names;
    for (const View& candidate : scene.views) names.push_back(candidate.name);
    return failure(ErrorKind::kUsage, fmt::format("--view {}: no such view{}; there are {} to {}", arguments.view,
                                                  did_you_mean(arguments.view, names), names.front(), names.back()));
  }
  QUORUM_ASSIGN(const auto mesh, read_mesh(arguments, scene));
  if (mesh.mesh.vertices.empty())
    return failure(ErrorKind::kInput,
                   fmt::format("{}: has no vertex, so there is nothing to draw; check the run that made it",
                               arguments.mesh.string()));
  if (arguments.turntable > 0) return draw_around(arguments, scene, *view, mesh, options);
  if (mesh.mesh.triangles.empty() && arguments.compares)
    return failure(ErrorKind::kUsage, "--compare: takes a surface; a cloud leaves gaps");
  Mask whole;
  QUORUM_ASSIGN(const auto image, draw(mesh, *view, view->camera, options, &whole));
  if (arguments.compares)
    QUORUM_TRY(
        compare(scene, arguments.options.mask_below, static_cast<int>(view - scene.views.begin()), image, whole));
  return write_image(arguments.output, image);
}

}  // namespace

int render_command(int argc, char** argv) {
  CommandLine line("Draw a mesh, or a cloud of points, as one of the scene's cameras sees it.", "render");
  RenderArguments arguments;
  line.add("mesh", arguments.mesh, "PLY file, or GLB file of quorum texture or simplify").required();
  line.add("--scene", arguments.scene, "Folder of the scene").required();
  add_named_options(line, arguments.options, {"format", "images", "model", "masks", "mask-below", "max-image-size"});
  line.add("--view", arguments.view, "Name of the view: its photograph, with or without extension").required();
  line.add("-o,--output", arguments.output, "Picture: .png, .jpg, .tif, .bmp or .webp; a folder with --turntable")
      .required();
  line.add("--shading", arguments.shading, "What to show")
      .one_of({"shaded", "color", "confidence", "normal", "error"})
      .with_default();
  line.add("--truth", arguments.truth, "PLY file of the true surface, for --shading error");
  line.add("--full-error", arguments.full_error, "Distance from the truth that is drawn red; 0 is blue").with_default();
  line.add("--turntable", arguments.turntable,
           "So many pictures on a way around the mesh that begins at the view: 0000.png and on")
      .between(2, 9999);
  line.add_switch("--compare", arguments.compares,
                  "Tell PSNR and SSIM against the photograph where the mesh is seen; for --shading color");
  return run_command(line, argc, argv, [&] { return render_file(arguments); });
}

}  // namespace quorum
