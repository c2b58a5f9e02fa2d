#include "engine/pipeline/colmap_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/io/colmap.h"
#include "engine/io/colmap_map.h"
#include "engine/io/file.h"
#include "engine/io/scene_pictures.h"
#include "engine/pipeline/memory_budget.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

const View& view_at(const Scene& scene, int index) { return scene.views[static_cast<std::size_t>(index)]; }

/// Views that have a depth map and those that each is compared with.
struct Reference {
  int view = 0;
  std::vector<int> neighbors;
};

std::vector<Reference> references_of(const Scene& scene, const ReconstructOptions& options,
                                     const Workspace& workspace) {
  std::vector<Reference> references;
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view)
    if (workspace.has_depth_map(view_at(scene, view).name))
      references.push_back({view, select_views(scene, view, options.views)});
  return references;
}

Expected<DepthMap> load(const Scene& scene, const Workspace& workspace, int view) {
  const View& source = view_at(scene, view);
  return workspace.load_depth_map(source.name, source.width, source.height);
}

/// Adds points of one depth map, on a grid of its pixels, with the neighbors whose maps agree within a hundredth.
Expected<void> add_points(const Scene& scene, const Workspace& workspace, const Reference& reference,
                          const Grid<float>& depth, std::vector<SparsePoint>& points) {
  constexpr int kStep = 8;
  constexpr double kAgreement = 0.01;
  const std::size_t first = points.size();
  for (int y = kStep / 2; y < depth.height; y += kStep)
    for (int x = kStep / 2; x < depth.width; x += kStep)
      if (const float d = depth.at(x, y); d > 0.0F)
        points.push_back(
            {view_at(scene, reference.view).camera.unproject(x, y, static_cast<double>(d)), {reference.view}});
  for (const int neighbor : reference.neighbors) {
    const View& view = view_at(scene, neighbor);
    if (!workspace.has_depth_map(view.name)) continue;
    const auto other = load(scene, workspace, neighbor);
    if (!other) return std::unexpected(other.error());
    for (std::size_t i = first; i < points.size(); ++i) {
      const Eigen::Vector3d pixel = view.camera.project(points[i].position);
      const int x = static_cast<int>(std::lround(std::clamp(pixel.x(), -1e6, 1e6)));
      const int y = static_cast<int>(std::lround(std::clamp(pixel.y(), -1e6, 1e6)));
      if (!(pixel.z() > 0) || !other->depth.contains(x, y)) continue;
      const double found = static_cast<double>(other->depth.at(x, y));
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
  if (auto written = write_file(stereo / "patch-match.cfg", pairs); !written) return written;
  return write_file(stereo / "fusion.cfg", fused);
}

/// What is held at most: the maps of a view and of one neighbor with its normals and a file's bytes, a photograph, and
/// the model's points, in memory and as bytes.
std::uint64_t workspace_bytes(const Scene& scene, const std::vector<Reference>& references) {
  constexpr std::uint64_t kPixelBytes = 12 + 12 + 12 + 12;
  constexpr std::uint64_t kPhotographBytes = 16;
  constexpr std::uint64_t kPointBytes = 200;
  constexpr std::uint64_t kSightingBytes = 100;
  const auto area = [](int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  };
  std::uint64_t pixels = 0;
  std::uint64_t photograph = 0;
  for (const View& view : scene.views) {
    pixels = std::max(pixels, area(view.width, view.height));
    photograph = std::max(photograph, area(view.photo_width, view.photo_height));
  }
  std::uint64_t points = 0;
  for (const SparsePoint& point : scene.points) points += kPointBytes + kSightingBytes * point.views.size();
  if (scene.points.empty())  // one for every 64 pixels of a depth map, as add_points makes them
    for (const Reference& reference : references)
      points += area(view_at(scene, reference.view).width, view_at(scene, reference.view).height) / 64 *
                (kPointBytes + kSightingBytes * (1 + reference.neighbors.size()));
  return kPixelBytes * pixels + kPhotographBytes * std::max(pixels, photograph) + points;
}

}  // namespace

Expected<void> write_colmap_workspace(const fs::path& folder, const Scene& scene, const ReconstructOptions& options,
                                      const Workspace& workspace, Progress& progress) {
  for (const View& view : scene.views)
    if (view.camera.intrinsics(0, 1) != 0.0)
      return failure(ErrorKind::kInput,
                     fmt::format("{}: its camera has skew, which COLMAP's workspaces have not", view.name));
  const std::vector<Reference> references = references_of(scene, options, workspace);
  if (references.empty())
    return failure(ErrorKind::kInput, fmt::format("{}: holds no depth map of this scene; run `quorum depth` first",
                                                  (workspace.folder() / "depth").string()));
  const MemoryBudget budget(options.memory_bytes);
  if (auto fits = budget.require(workspace_bytes(scene, references), "writing for COLMAP"); !fits) return fits;
  for (const char* name : {"images", "sparse", "stereo/depth_maps", "stereo/normal_maps", "stereo/consistency_graphs"})
    if (auto made = make_folder(folder / name); !made) return made;
  const std::vector<std::string> names = picture_names(scene);
  progress.stage("writing for COLMAP", static_cast<int>(references.size()));
  std::vector<SparsePoint> points = scene.points;
  for (const Reference& reference : references) {
    if (progress.stop_requested()) return failure(ErrorKind::kStopped, "stopped as asked; finished files are kept");
    const auto map = load(scene, workspace, reference.view);
    if (!map) return std::unexpected(map.error());
    if (scene.points.empty())
      if (auto added = add_points(scene, workspace, reference, map->depth, points); !added) return added;
    const std::string file = names[static_cast<std::size_t>(reference.view)] + ".geometric.bin";
    for (const char* maps : {"depth_maps", "normal_maps"})
      if (auto made = make_folder((folder / "stereo" / maps / file).parent_path()); !made) return made;
    if (auto written = write_colmap_map(folder / "stereo/depth_maps" / file, map->depth); !written) return written;
    const View& view = view_at(scene, reference.view);
    const auto normals = workspace.load_normals(view.name, view.width, view.height);
    if (!normals) return std::unexpected(normals.error());
    if (auto written = write_colmap_map(folder / "stereo/normal_maps" / file, *normals); !written) return written;
    progress.step();
  }
  if (auto written = write_pictures(folder / "images", scene, names); !written) return written;
  if (auto written = write_colmap_model(folder / "sparse", colmap_model_of(scene.views, names, points)); !written)
    return written;
  return write_lists(folder / "stereo", names, references);
}

}  // namespace quorum
