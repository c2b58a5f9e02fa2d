// All options of a run, and the one table that names them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/option.h"
#include "engine/core/simd.h"
#include "engine/depth/sweep_options.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "engine/mesh/clean.h"
#include "engine/pipeline/saved_files.h"
#include "engine/pipeline/shard.h"
#include "engine/scene/select_views.h"
#include "engine/volume/fusion_options.h"

namespace quorum {

/// The defaults are those of the program.
struct RunOptions {
  SceneOptions files;
  SelectViewsOptions views;
  SweepOptions sweep;
  double mask_below = 0.0;  ///< level of the dark-background mask, 0..1; 0 = none (paper 4.6)
  bool confirm = true;      ///< weigh depths by what other views' depth maps make of them, not by conf(d)
  int confirm_rounds = 3;   ///< in which depths go that deny surer ones of other views, 0..8
  int min_patch = 200;      ///< pixels; smaller patches of a depth map that no other view confirms take no part
  FusionOptions fusion;
  std::optional<float> min_confidence;  ///< for CleanOptions; empty = from the mesh itself
  CleanOptions clean;
  PlyFrame frame = PlyFrame::kWorld;  ///< of mesh, cloud and COLMAP's workspace
  bool cloud = false;                 ///< also a cloud of points
  int cloud_views = 3;                ///< that agree on a point of the cloud, 2..33
  bool colmap = false;                ///< also a dense workspace for COLMAP
  bool texture = false;               ///< also model.glb, with the photographs on it
  std::uint64_t triangles = 0;        ///< also model.glb, with no more of them; 0 = all that the mesh has

  /// Whether model.glb is wanted.
  [[nodiscard]] bool has_model() const { return texture || triangles > 0; }

  // What follows changes no result.
  std::string device = "auto";     ///< auto, cpu, an index or a part of a device's name
  int threads = 0;                 ///< of the CPU; 0 = all
  std::uint64_t memory_bytes = 0;  ///< that the process may hold; 0 = automatic (MemoryBudget)
  std::optional<SimdLevel> simd;   ///< of the CPU's kernels; empty = the most that the processor has
  int tile_width = 64;             ///< pixels of the CPU's sweep
  int tile_height = 16;
  Previews previews = Previews::kSmall;       ///< of a view's maps
  SavedMaps saved_maps = SavedMaps::kNeeded;  ///< of a view's maps, which are written
  std::optional<Shard> shard;                 ///< the part of a stage that is worked on; empty = all

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
  /// The files that saved_maps and previews ask for.
  [[nodiscard]] SavedFiles saved_files() const;
};

/// The first stage whose result an option changes; the results of later stages change with it.
enum class RunStage {
  kScene,    ///< what is read
  kDepth,    ///< depth maps
  kConfirm,  ///< the certainty of depths
  kFusion,   ///< the volume
  kClean,    ///< the mesh
  kExtras,   ///< files beside the mesh
  kNone,     ///< no result: how the work is done
  kFiles,    ///< no result: which files are written
  kShards,   ///< no result: which part of the work is done
};

struct RunOption : Option<RunOptions> {
  RunStage stage = RunStage::kNone;
};

/// All options of a run by stage.
const std::vector<RunOption>& run_option_table();

/// What a stage's options are about, as a heading: "Depth maps (the paper, sections 2.1 and 4.1)".
std::string_view stage_heading(RunStage stage);

/// The table as docs/options.md shows it.
std::string run_options_markdown();

}  // namespace quorum
