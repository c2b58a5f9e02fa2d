#include "engine/pipeline/colmap_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/io/colmap.h"
#include "engine/io/colmap_map.h"
#include "engine/io/file.h"
#include "engine/io/scene_pictures.h"
#include "engine/scene/local_frame.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// Views that have a depth map and those that each is compared with.
struct Reference {
  int view = 0;
  std::vector<int> neighbors;
};

Expected<std::vector<Reference>> references_of(Run& run) {
  QUORUM_ASSIGN(const std::vector<int> views, run.views_with_depth_map());
  std::vector<Reference> references;
  std::vector<std::size_t> neighbor_count;
  for (const int view : views) {
    references.push_back({view, select_views(run.scene, view, run.options.views)});
    neighbor_count.push_back(references.back().neighbors.size());
  }
  QUORUM_TRY(run.require(colmap_memory(run.scene, views, neighbor_count), "writing for COLMAP"));
  return references;
}

Expected<Grid<float>> load(const Run& run, int view) {
  const View& source = run.view(view);
  return run.workspace.load_depth(source.name, source.width, source.height);
}

/// Adds points of one depth map, on a grid of its pixels, with the neighbors whose maps agree within a hundredth.
Expected<void> add_points(const Run& run, const Reference& reference, const Grid<float>& depth,
                          std::vector<SparsePoint>& points) {
  constexpr int kStep = 8;
  constexpr double kAgreement = 0.01;
  const std::size_t first = points.size();
  for (int y = kStep / 2; y < depth.height; y += kStep)
    for (int x = kStep / 2; x < depth.width; x += kStep)
      if (const float d = depth.at(x, y); d > 0.0F)
        points.push_back({run.view(reference.view).camera.unproject(x, y, static_cast<double>(d)), {reference.view}});
  for (const int neighbor : reference.neighbors) {
    const View& view = run.view(neighbor);
    if (!run.workspace.has_depth_map(view.name)) continue;
    QUORUM_ASSIGN(const auto other, load(run, neighbor));
    for (std::size_t i = first; i < points.size(); ++i) {
      const Eigen::Vector3d pixel = view.camera.project(points[i].position);
      const int x = static_cast<int>(std::lround(std::clamp(pixel.x(), -1e6, 1e6)));
      const int y = static_cast<int>(std::lround(std::clamp(pixel.y(), -1e6, 1e6)));
      if (!(pixel.z() > 0) || !other.contains(x, y)) continue;
      const double found = static_cast<double>(other.at(x, y));
      if (std::abs(found - pixel.z()) < kAgreement * pixel.z()) points[i].views.push_back(neighbor);
    }
  }
  for (std::size_t i = first; i < points.size(); ++i) std::ranges::sort(points[i].views);
  return {};
}

Expected<void> write_lists(const fs::path& stereo, const std::vector<std::string>& names,
                           const std::vector<Reference>& references) {
  std::string pairs;
  std::string fused;
  for (const Reference& reference : references) {
    const std::string& name = names[static_cast<std::size_t>(reference.view)];
    fused += name + "\n";
    pairs += name + "\n";
    const char* separator = "";
    for (const int neighbor : reference.neighbors) {
      pairs += separator + names[static_cast<std::size_t>(neighbor)];
      separator = ", ";
    }
    pairs += "\n";
  }
  QUORUM_TRY(write_file(stereo / "patch-match.cfg", pairs));
  return write_file(stereo / "fusion.cfg", fused);
}

/// The maps of a view.
Expected<void> write_maps(const Run& run, int index, const Grid<float>& depth, const std::string& name) {
  const fs::path stereo = run.workspace.colmap_path() / "stereo";
  const std::string file = name + ".geometric.bin";
  for (const char* maps : {"depth_maps", "normal_maps"}) QUORUM_TRY(make_folder((stereo / maps / file).parent_path()));
  QUORUM_TRY(write_colmap_map(stereo / "depth_maps" / file, depth));
  const View& view = run.view(index);
  QUORUM_ASSIGN(const auto normals, run.workspace.load_normals(view.name, view.width, view.height));
  return write_colmap_map(stereo / "normal_maps" / file, normals);
}

}  // namespace

Expected<void> check_colmap_workspace(const Run& run) {
  for (const View& view : run.scene.views)
    if (view.camera.intrinsics(0, 1) != 0.0)
      return failure(ErrorKind::kInput,
                     fmt::format("{}: its camera has skew, which COLMAP's workspaces have not", view.name));
  // Pictures are written first, with a list of them; what stands here without it is another's.
  const fs::path folder = run.workspace.colmap_path();
  std::error_code ignored;
  if (fs::exists(folder / ".quorum-files", ignored)) return {};
  for (const char* name : {"sparse/cameras.bin", "sparse/images.bin", "sparse/points3D.bin", "stereo/patch-match.cfg",
                           "stereo/fusion.cfg"})
    if (fs::exists(fs::symlink_status(folder / name, ignored)))
      return failure(ErrorKind::kInput,
                     fmt::format("{}: is there already and was not written by quorum; choose another output folder",
                                 (folder / name).string()));
  return {};
}

Expected<void> write_colmap_workspace(Run& run) {
  const StageTimer timer(run.report, "write_colmap");
  QUORUM_TRY(check_colmap_workspace(run));
  QUORUM_ASSIGN(const std::vector<Reference> references, references_of(run));
  const fs::path folder = run.workspace.colmap_path();
  for (const char* name : {"images", "sparse", "stereo/depth_maps", "stereo/normal_maps", "stereo/consistency_graphs"})
    QUORUM_TRY(make_folder(folder / name));
  const std::vector<std::string> names = picture_names(run.scene);
  run.progress.stage("writing for COLMAP", static_cast<int>(references.size()));
  std::vector<SparsePoint> points = run.scene.points;
  for (const Reference& reference : references) {
    if (run.progress.stop_requested()) return std::unexpected(stopped());
    QUORUM_ASSIGN(const auto depth, load(run, reference.view));
    if (run.scene.points.empty()) QUORUM_TRY(add_points(run, reference, depth, points));
    QUORUM_TRY(write_maps(run, reference.view, depth, names[static_cast<std::size_t>(reference.view)]));
    run.progress.step();
  }
  QUORUM_TRY(write_pictures(folder / "images", run.scene, names));
  Scene written{run.scene.views, run.scene.bounds, std::move(points), {}, run.scene.offset};
  if (run.options.frame == PlyFrame::kWorld) written = in_world(std::move(written));
  QUORUM_TRY(write_colmap_model(folder / "sparse", colmap_model_of(written.views, names, written.points)));
  return write_lists(folder / "stereo", names, references);
}

}  // namespace quorum
