// The output folder of a run: depth maps per view, the mesh, the report.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/depth/depth_map.h"
#include "engine/io/file.h"
#include "engine/pipeline/saved_files.h"
#include "engine/pipeline/shard.h"

namespace quorum {

/// Files under one folder; every file appears whole or not at all.
///   depth/NAME.depth.pfm .correlation.pfm .confidence.pfm   float maps
///   depth/NAME.normal.pfm                                   unit normals in the camera frame, three channels
///   depth/NAME.certainty.pfm                                what other views' depth maps make of it
///   depth/NAME.depth.json .certainty.json                   what these were made from (provenance.h)
///   depth/NAME.depth.png .correlation.png .confidence.png .normal.png .certainty.png   previews
///   mesh.ply, run.json
///   verified.json                                           devices on which the same run gave the same bytes
///   shards/STAGE-I-of-N.json                                what a shard did; STAGE: depth, confirm or fuse
///   shards/fuse-I-of-N.part                                 a shard's part of the surface (surface_part.h)
///   model.glb                                               simpler, or with the photographs on it, if asked for
///   fused.ply, colmap/                                      a cloud, and a dense workspace for COLMAP, if asked for
class Workspace {
 public:
  /// Makes the folder. Fails (kInput) if it can't be made or written to, or as check_ours does.
  static Expected<Workspace> open(const std::filesystem::path& folder);

  /// Fails (kInput) if the folder is not a run's and holds a mesh, a cloud or a report under the name of ours, which a
  /// run would remove and replace: a scene's own folder, or the workspace of another program.
  static Expected<void> check_ours(const std::filesystem::path& folder);

  /// The folder as it is, to look into; it may be absent.
  static Workspace at(const std::filesystem::path& folder) { return Workspace(folder); }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path mesh_path() const { return folder_ / "mesh.ply"; }
  [[nodiscard]] std::filesystem::path model_path() const { return folder_ / "model.glb"; }
  [[nodiscard]] std::filesystem::path cloud_path() const { return folder_ / "fused.ply"; }
  [[nodiscard]] std::filesystem::path colmap_path() const { return folder_ / "colmap"; }
  [[nodiscard]] std::filesystem::path report_path() const { return folder_ / "run.json"; }
  [[nodiscard]] std::filesystem::path verified_path() const { return folder_ / "verified.json"; }

  /// True if a depth map of this view was saved, to the end.
  [[nodiscard]] bool has_depth_map(const std::string& view) const;
  /// Saves maps and previews, and removes what is left of those that are not asked for. The record of what they were
  /// made from comes last, so has_depth_map means that all is there. Fails (kInput).
  [[nodiscard]] Expected<void> save_depth_map(const std::string& view, const DepthMap& map,
                                              std::string_view record = "", const SavedFiles& files = {}) const;
  /// True if the maps that are asked for are there in their full lengths; someone may have cut or removed one.
  [[nodiscard]] bool has_maps(const std::string& view, const SavedFiles& files) const;
  /// The record of a view's depth map; empty if there is none.
  [[nodiscard]] std::string depth_record(const std::string& view) const;
  /// Loads the maps of a view but its normals, and checks that they fit its size and hold numbers from 0 up. Fails
  /// (kInput).
  [[nodiscard]] Expected<DepthMap> load_depth_map(const std::string& view, int width, int height) const;
  /// Loads depth and confidence alone; with_certainty: the certainty in place of the latter.
  [[nodiscard]] Expected<DepthMap> load_weighed_depth(const std::string& view, int width, int height,
                                                      bool with_certainty) const;
  /// Loads the depth of a view alone. Fails (kInput) as load_depth_map does.
  [[nodiscard]] Expected<Grid<float>> load_depth(const std::string& view, int width, int height) const;
  /// Loads the normals of a view, as DepthMap::normal. Fails (kInput) as load_depth_map does.
  [[nodiscard]] Expected<Grid<Eigen::Vector3f>> load_normals(const std::string& view, int width, int height) const;
  /// Saves the certainty of a view's depths (confirm_depths), its preview first and its record last. Fails (kInput).
  [[nodiscard]] Expected<void> save_certainty(const std::string& view, const Grid<float>& certainty,
                                              std::string_view record = "", Previews previews = Previews::kSmall) const;
  /// The record of a view's certainty; empty if there is none that was saved to the end.
  [[nodiscard]] std::string certainty_record(const std::string& view) const;
  /// Loads it. Fails (kInput) as load_depth_map does.
  [[nodiscard]] Expected<Grid<float>> load_certainty(const std::string& view, int width, int height) const;
  /// Removes the certainty of a view, which an earlier run may have left.
  void remove_certainty(const std::string& view) const;
  /// Removes what is left of a view from an earlier run, the record first.
  void remove_depth_map(const std::string& view) const;
  /// The file of a shard; kind: json or part.
  [[nodiscard]] std::filesystem::path shard_path(std::string_view stage, const Shard& shard,
                                                 std::string_view kind) const;
  /// The shards of a stage that left such a file.
  [[nodiscard]] std::vector<Shard> find_shards(std::string_view stage, std::string_view kind) const;
  /// Removes what shards left of a stage.
  void remove_shards(std::string_view stage) const;
  /// Removes what an earlier run made of the depth maps: mesh, cloud and report, with what verified it.
  void remove_mesh() const { remove_file(mesh_path()); }
  void remove_model() const { remove_file(model_path()); }
  void remove_cloud() const { remove_file(cloud_path()); }
  void remove_report() const;

 private:
  explicit Workspace(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// The map if it fits the view.
  template <typename Value>
  [[nodiscard]] Expected<Grid<Value>> fitting(const std::string& view, const char* map, int width, int height,
                                              Expected<Grid<Value>> loaded) const;
  /// The file of a map. Fails (kInput) if it is not there.
  [[nodiscard]] Expected<std::filesystem::path> find_map(const std::string& view, const char* map) const;
  [[nodiscard]] Expected<Grid<float>> load_map(const std::string& view, const char* map, int width, int height) const;
  /// Adds the preview of a map, or removes what is left of one.
  template <typename Color, typename Value>
  [[nodiscard]] Expected<void> add_preview(const std::string& view, const char* map, const Grid<Value>& values,
                                           Previews previews, const Color& color, FileGroup& group) const;
  [[nodiscard]] std::filesystem::path map_path(const std::string& view, const char* map, const char* kind) const;

  std::filesystem::path folder_;
};

}  // namespace quorum
