// What depth maps and certainties were made from, as records that lie beside them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/pipeline/run.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// Makes the records of a run: JSON text, equal where the same bytes come of it. A file's bytes are read once.
class Provenance {
 public:
  explicit Provenance(const Run& run) : run_(run) {}

  /// Of a view's depth map: version of the stage, its options, photographs, masks, cameras and the box. Fails (kInput)
  /// if a file can't be read.
  Expected<std::string> depth_record(int view, const std::vector<int>& neighbors);
  /// Of a view's certainty: version, options, and the records of the depth maps that it was made from, which are in the
  /// workspace: those of the views that it is compared with, and of all in reach, whose certainties have a part in it.
  /// Empty if the view's own map has none.
  [[nodiscard]] std::string certainty_record(int view, const std::vector<int>& others, const std::vector<int>& reach);
  /// Of a shard's part of the surface: version, options, the grid, and the records of depth maps and certainties that
  /// it was made from, which are in the workspace.
  [[nodiscard]] std::string surface_record(const std::vector<int>& views, const VoxelGrid& grid, const Shard& shard);
  /// Fails (kInput) unless the depth maps of these views were made of this scene, by this version, with the same
  /// options and box as each other; names the first that was not, what differs, and the remedy. A shard reads the
  /// photographs of its views alone.
  Expected<void> check_depth_maps(const std::vector<int>& views);

 private:
  Expected<std::string> digest_of(const std::filesystem::path& path);
  const std::string& digest_of_record(int view);

  const Run& run_;
  std::map<std::filesystem::path, std::string> files_;
  std::map<int, std::string> records_;
};

/// Takes the options of the depth maps from the first of the workspace's records, but the mask's level; leaves them as
/// they are if there is none. Fails (kInput) if the record holds what is no option.
Expected<void> take_depth_options(RunOptions& options, const Scene& scene, const Workspace& workspace);

/// Takes the options of certainties and volume from such a record of a surface. Fails (kInput) if it holds what is no
/// option.
Expected<void> take_surface_options(RunOptions& options, const std::string& record);

}  // namespace quorum
