#include "engine/io/convert_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "engine/camera/pose.h"
#include "engine/io/colmap.h"
#include "engine/io/mvsnet.h"
#include "engine/io/output_folder.h"
#include "engine/io/scene_pictures.h"
#include "engine/io/transforms.h"
#include "engine/scene/local_frame.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// A scene as all formats hold it, with what they hold instead of R and t.
struct SettledScene {
  Scene scene;
  std::vector<std::array<double, 4>> quaternions;
  std::vector<Eigen::Vector3d> centers;
};

/// The scene with its views in another order; order: their old places.
Scene reordered(const Scene& scene, const std::vector<std::size_t>& order) {
  std::vector<int> place_of(order.size());
  for (std::size_t place = 0; place < order.size(); ++place) place_of[order[place]] = static_cast<int>(place);
  const auto move_all = [&](std::vector<int>& views) {
    for (int& view : views) view = place_of[static_cast<std::size_t>(view)];
  };
  Scene result{{}, scene.bounds, scene.points};
  for (const std::size_t old : order) {
    result.views.push_back(scene.views[old]);
    move_all(result.views.back().neighbors);
  }
  for (SparsePoint& point : result.points) {
    move_all(point.views);
    std::ranges::sort(point.views);
  }
  return result;
}

SettledScene settle(const Scene& scene) {
  const std::vector<std::string> names = picture_names(scene);
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&names](std::size_t view) { return names[view]; });
  SettledScene settled{reordered(scene, order), {}, {}};
  for (View& view : settled.scene.views) {
    Camera& camera = view.camera;
    settled.quaternions.push_back(quaternion_of_rotation(camera.camera_from_world));
    camera.camera_from_world = rotation_of_quaternion(settled.quaternions.back());
    settled.centers.push_back(camera.center());
    camera.translation = translation_of_center(camera.camera_from_world, settled.centers.back());
    for (int axis = 0; axis < 2; ++axis) camera.intrinsics(axis, 2) = (camera.intrinsics(axis, 2) + 0.5) - 0.5;
  }
  return settled;
}

Expected<void> write_colmap(OutputFolder& output, const SettledScene& settled, const std::vector<std::string>& names,
                            bool text) {
  ColmapModel model = colmap_model_of(settled.scene.views, names, settled.scene.points);
  for (std::size_t i = 0; i < names.size(); ++i) model.images[i].rotation = settled.quaternions[i];
  QUORUM_ASSIGN(const auto files,
                text ? format_colmap_model_txt(model) : Expected<std::vector<NamedBytes>>(format_colmap_model(model)));
  for (const auto& [name, bytes] : files) QUORUM_TRY(output.write(fs::path("sparse") / name, bytes));
  return {};
}

/// transforms.json, with the maps that there are.
Expected<void> write_frames(OutputFolder& output, const SettledScene& settled, const std::vector<std::string>& names,
                            const PriorSource& priors) {
  std::vector<std::string> members(names.size());
  for (std::size_t i = 0; priors && i < names.size(); ++i) {
    QUORUM_ASSIGN(const auto maps, priors(settled.scene.views[i]));
    if (!maps) continue;
    QUORUM_ASSIGN(members[i], write_prior_maps(output, names[i], *maps));
  }
  return write_transforms(output, settled.scene.views, names, settled.centers, members);
}

}  // namespace

Expected<void> convert_scene(const fs::path& folder, const Scene& scene, ConvertedFormat format,
                             const PriorSource& priors) {
  for (const View& view : scene.views)
    if (view.camera.intrinsics(0, 1) != 0.0)
      return failure(ErrorKind::kInput,
                     fmt::format("{}: its camera has skew, which the other formats have not", view.name));
  const SettledScene settled = settle(in_world(scene));
  std::vector<std::string> names = picture_names(settled.scene);
  if (format == ConvertedFormat::kMvsnet)
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = mvsnet_name(i) + fs::path(names[i]).extension().string();
  QUORUM_TRY(write_pictures(folder / "images", settled.scene, names));
  QUORUM_ASSIGN(auto output, OutputFolder::open(folder));
  Expected<void> written;
  if (format == ConvertedFormat::kMvsnet)
    written = write_mvsnet(output, settled.scene);
  else if (format == ConvertedFormat::kTransforms)
    written = write_frames(output, settled, names, priors);
  else
    written = write_colmap(output, settled, names, format == ConvertedFormat::kColmapText);
  if (!written) return written;
  const auto& [low, high] = settled.scene.bounds;
  return output.write("bounds.txt",
                      fmt::format("{} {} {}\n{} {} {}\n", low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
}

}  // namespace quorum
