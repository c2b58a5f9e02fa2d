// The output folder of a run: depth maps per view, the mesh, the report.
#pragma once

#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "engine/depth/depth_map.h"

namespace quorum {

/// Files under one folder; every file appears whole or not at all.
///   depth/NAME.depth.pfm .correlation.pfm .confidence.pfm   float maps
///   depth/NAME.normal.pfm                                   unit normals in the camera frame, three channels
///   depth/NAME.certainty.pfm                                what other views' depth maps make of it
///   depth/NAME.depth.png .correlation.png .confidence.png .normal.png .certainty.png   previews
///   mesh.ply, run.json
///   fused.ply, colmap/                                      a cloud, and a dense workspace for COLMAP, if asked for
class Workspace {
 public:
  /// Makes the folder. Fails (kInput) if it can't be made or written to.
  static Expected<Workspace> open(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path mesh_path() const { return folder_ / "mesh.ply"; }
  [[nodiscard]] std::filesystem::path cloud_path() const { return folder_ / "fused.ply"; }
  [[nodiscard]] std::filesystem::path colmap_path() const { return folder_ / "colmap"; }
  [[nodiscard]] std::filesystem::path report_path() const { return folder_ / "run.json"; }

  /// True if a depth map of this view was saved.
  [[nodiscard]] bool has_depth_map(const std::string& view) const;
  /// Saves maps and previews; normals if there are any. The depth itself comes last, so has_depth_map means that all is
  /// there. Fails (kInput).
  [[nodiscard]] Expected<void> save_depth_map(const std::string& view, const DepthMap& map) const;
  /// Loads the maps of a view but its normals, and checks that they fit its size. Fails (kInput).
  [[nodiscard]] Expected<DepthMap> load_depth_map(const std::string& view, int width, int height) const;
  /// Loads the depth of a view alone. Fails (kInput) as load_depth_map does.
  [[nodiscard]] Expected<Grid<float>> load_depth(const std::string& view, int width, int height) const;
  /// Loads the normals of a view, as DepthMap::normal. Fails (kInput) as load_depth_map does.
  [[nodiscard]] Expected<Grid<Eigen::Vector3f>> load_normals(const std::string& view, int width, int height) const;
  /// Saves the certainty of a view's depths (confirm_depths), and its preview first. Fails (kInput).
  [[nodiscard]] Expected<void> save_certainty(const std::string& view, const Grid<float>& certainty) const;
  /// Loads it. Fails (kInput) as load_depth_map does.
  [[nodiscard]] Expected<Grid<float>> load_certainty(const std::string& view, int width, int height) const;
  /// Removes the certainty of a view, which an earlier run may have left.
  void remove_certainty(const std::string& view) const;
  /// Removes what is left of a view from an earlier run.
  void remove_depth_map(const std::string& view) const;

 private:
  explicit Workspace(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// The map if it fits the view.
  template <typename Value>
  [[nodiscard]] Expected<Grid<Value>> fitting(const std::string& view, const char* map, int width, int height,
                                              Expected<Grid<Value>> loaded) const;
  [[nodiscard]] Expected<Grid<float>> load_map(const std::string& view, const char* map, int width, int height) const;
  [[nodiscard]] std::filesystem::path map_path(const std::string& view, const char* map, const char* kind) const;

  std::filesystem::path folder_;
};

}  // namespace quorum
