// Scenes of arrays: their photographs become files of a temporary folder, where the engine looks for them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/io/scene_folder.h"
#include "engine/io/text.h"
#include "engine/io/view_names.h"
#include "engine/io/write_image.h"
#include "host/api/boundary.h"
#include "host/api/options_state.h"
#include "host/api/scene_state.h"
#include "host/run/open_backend.h"

namespace quorum::v0 {
namespace {

using quorum::Expected;

std::unexpected<quorum::Error> bad(std::string message) {
  return quorum::failure(quorum::ErrorKind::kInput, std::move(message));
}

Expected<void> check_pixels(const PixelArray& pixels, const char* what) {
  if (pixels.data == nullptr) return bad(fmt::format("its {} has no data", what));
  if (pixels.width < 1 || pixels.height < 1)
    return bad(fmt::format("its {} is {} x {} pixels; give 1 or more", what, pixels.width, pixels.height));
  if (pixels.channels != 1 && pixels.channels != 3)
    return bad(fmt::format("its {} has {} channels; give 1 or 3, of 8 bits each", what, pixels.channels));
  const std::ptrdiff_t row = std::ptrdiff_t{pixels.width} * pixels.channels;
  if (pixels.stride != 0 && std::abs(pixels.stride) < row)
    return bad(fmt::format("the stride of its {} is {} bytes, but a row has {}", what, pixels.stride, row));
  return {};
}

quorum::ColorImage image_of(const PixelArray& pixels) {
  const std::ptrdiff_t stride = pixels.stride != 0 ? pixels.stride : std::ptrdiff_t{pixels.width} * pixels.channels;
  quorum::ColorImage image(pixels.width, pixels.height);
  for (int y = 0; y < pixels.height; ++y) {
    const std::uint8_t* row = pixels.data + y * stride;
    for (int x = 0; x < pixels.width; ++x) {
      const std::uint8_t* pixel = row + std::ptrdiff_t{x} * pixels.channels;
      if (pixels.channels == 1)
        image.at(x, y) = quorum::make_rgb(pixel[0], pixel[0], pixel[0]);
      else
        image.at(x, y) = quorum::make_rgb(pixel[pixels.is_bgr ? 2 : 0], pixel[1], pixel[pixels.is_bgr ? 0 : 2]);
    }
  }
  return image;
}

quorum::ColorImage mask_of(const PixelArray& pixels) {
  quorum::ColorImage mask = image_of(pixels);
  for (quorum::Rgba& pixel : mask.values)
    pixel = quorum::red_of(pixel) > 0 ? quorum::make_rgb(255, 255, 255) : quorum::make_rgb(0, 0, 0);
  return mask;
}

Expected<quorum::Camera> camera_of(const Camera& given) {
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  quorum::Camera camera;
  camera.intrinsics = Eigen::Map<const Rows>(given.intrinsics.data());
  camera.camera_from_world = Eigen::Map<const Rows>(given.camera_from_world.data());
  camera.translation = Eigen::Map<const Eigen::Vector3d>(given.translation.data());
  if (const char* defect = quorum::camera_defect(camera); defect != nullptr) return bad(defect);
  return camera;
}

Expected<void> check_neighbors(const ViewArrays& given, int index, int view_count) {
  for (const int neighbor : given.neighbors)
    if (neighbor < 0 || neighbor >= view_count || neighbor == index)
      return bad(fmt::format("its neighbor {} is no other view; give 0 to {}", neighbor, view_count - 1));
  return {};
}

/// The view, with image and mask written to the folder. index: of view_count.
Expected<quorum::View> view_of(const ViewArrays& given, int index, int view_count,
                               const std::filesystem::path& folder) {
  QUORUM_TRY(check_pixels(given.image, "image"));
  QUORUM_TRY(check_neighbors(given, index, view_count));
  if (!(given.near_depth >= 0) || !std::isfinite(given.far_depth) ||
      (given.far_depth != 0 && given.far_depth <= given.near_depth))
    return bad(fmt::format("its depths go from {} to {}; give 0 or more, the far one larger or 0", given.near_depth,
                           given.far_depth));
  quorum::View view;
  QUORUM_ASSIGN(view.camera, camera_of(given.camera));
  view.image_path = folder / fmt::format("{:06}.png", index + 1);
  QUORUM_TRY(quorum::write_png(view.image_path, image_of(given.image)));
  if (given.mask.data != nullptr) {
    QUORUM_TRY(check_pixels(given.mask, "mask"));
    if (given.mask.channels != 1 || given.mask.width != given.image.width || given.mask.height != given.image.height)
      return bad(fmt::format("its mask is {} x {} with {} channels; give one channel and the image's {} x {}",
                             given.mask.width, given.mask.height, given.mask.channels, given.image.width,
                             given.image.height));
    view.mask_path = folder / fmt::format("{:06}.mask.png", index + 1);
    QUORUM_TRY(quorum::write_png(view.mask_path, mask_of(given.mask)));
  }
  view.width = given.image.width;
  view.height = given.image.height;
  view.near_depth = given.near_depth;
  view.far_depth = given.far_depth;
  view.neighbors = given.neighbors;
  return view;
}

Expected<quorum::SparsePoint> point_of(const SparsePoint& given, int view_count) {
  quorum::SparsePoint point;
  point.position = Eigen::Map<const Eigen::Vector3d>(given.position.data());
  point.views = given.views;
  std::ranges::sort(point.views);
  const auto same = std::ranges::unique(point.views);
  point.views.erase(same.begin(), same.end());
  if (!point.position.allFinite()) return bad("its position is not finite");
  if (!point.views.empty() && (point.views.front() < 0 || point.views.back() >= view_count))
    return bad(fmt::format("its views are not all from 0 to {}", view_count - 1));
  return point;
}

Expected<quorum::Scene> scene_of(const SceneArrays& arrays, const std::filesystem::path& folder) {
  const auto view_count = static_cast<int>(arrays.views.size());
  if (view_count < 3)
    return bad(
        fmt::format("scene: holds {} views, expected 3 or more: a reference view and two neighbors", view_count));
  quorum::Scene scene;
  for (int index = 0; index < view_count; ++index) {
    const ViewArrays& given = arrays.views[static_cast<std::size_t>(index)];
    const std::string name = given.name.empty() ? fmt::format("view{:04}", index + 1) : given.name;
    const std::string place = fmt::format("view {}", quorum::quote_token(name));
    if (quorum::has_control_characters(name)) return bad(place + ": its name has control characters; rename it");
    auto view = view_of(given, index, view_count, folder);
    if (!view) return std::unexpected(view.error().within(place));
    view->image_name = name;
    scene.views.push_back(*std::move(view));
  }
  QUORUM_TRY(quorum::name_views(scene.views));
  for (std::size_t index = 0; index < arrays.points.size(); ++index) {
    auto point = point_of(arrays.points[index], view_count);
    if (!point) return std::unexpected(point.error().within(fmt::format("point {}", index)));
    scene.points.push_back(*std::move(point));
  }
  return scene;
}

/// The options that arrays have a use for, with their box.
Expected<quorum::RunOptions> options_for(const SceneArrays& arrays, const Options& options) {
  const auto refuse = [](const char* option, const char* remedy) {
    return quorum::failure(quorum::ErrorKind::kUsage, fmt::format("{}: {}", quorum::option_name(option), remedy));
  };
  QUORUM_ASSIGN(quorum::RunOptions run, run_options_of(options));
  for (const char* option : {"format", "images", "model"})
    if (is_given(options, option)) return refuse(option, "has no use for arrays; leave it out");
  if (!arrays.bounds) return run;
  if (run.files.bounds) return refuse("bounds", "the arrays have a box, too; give one of the two");
  const auto& box = *arrays.bounds;
  run.files.bounds = quorum::Bounds{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
  return run;
}

}  // namespace

Result<Scene> Scene::from_arrays(const SceneArrays& arrays, const Options& options) {
  return at_boundary<Scene>([&]() -> Expected<Scene> {
    QUORUM_ASSIGN(const quorum::RunOptions run, options_for(arrays, options));
    const quorum::ThreadLimit limit(run.threads);
    QUORUM_ASSIGN(quorum::ScratchFolder files, quorum::ScratchFolder::make());
    QUORUM_ASSIGN(quorum::Scene scene, scene_of(arrays, files.path()));
    QUORUM_ASSIGN(scene, quorum::complete_scene(std::move(scene), run.files));
    return Scene(std::make_shared<const State>(std::move(scene), run, std::move(files)));
  });
}

}  // namespace quorum::v0
