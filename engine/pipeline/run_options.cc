#include "engine/pipeline/run_options.h"

#include <fmt/format.h>

#include "engine/core/option_maker.h"
#include "engine/pipeline/special_options.h"

namespace quorum {
namespace {

using Make = OptionMaker<RunOptions>;

#define AT QUORUM_MEMBER

// A line an option: name, member, range, help with its unit. The paper's sections stand in the structs.
std::vector<RunOption> make_table() {
  std::vector<RunOption> table;
  const auto add = [&](RunStage stage, std::vector<Option<RunOptions>> options) {
    for (Option<RunOptions>& option : options) table.push_back({std::move(option), stage});
  };
  // clang-format off
  add(RunStage::kScene, {
    Make::choice("format", AT(files.format), scene_format_names(), "How the cameras are written; auto: as the folder shows"),
    Make::text("images", AT(files.images), "a folder", "Folder of the photographs; else beside the cameras"),
    Make::text("model", AT(files.model), "a folder", "Of several COLMAP models the one to take, such as sparse/1; else the largest"),
    Make::number("max-image-size", AT(files.max_image_size), {.least = 16, .or_zero = true}, "Halve photographs until no side has more pixels than this; 0: keep all"),
    bounds_option("bounds", "Box that holds the object; else that of the scene's files, or found"),
    Make::text("roi", AT(files.roi), "a file", "The same box from a file: six numbers, or a .ply whose extent is taken"),
    Make::text("masks", AT(files.masks), "a folder", "Folder with a mask per image (a.jpg.png or a.png); black is left out"),
  });
  add(RunStage::kDepth, {
    quality_option("quality", "draft: neighbors 3, step-pixels 4, no-slant; high: neighbors 6, step-pixels 1, second-window 9; what is given beside it overrules it"),
    Make::number("neighbors", AT(views.neighbor_count), {2, 32}, "Views that each view is compared with"),
    Make::choice("views", AT(views.rule), {{"auto", ViewRule::kAutomatic}, {"points", ViewRule::kPoints}, {"angle", ViewRule::kAngle}, {"parallax", ViewRule::kParallax}}, "How these are chosen. points: by shared sparse points; angle: the paper's rule; parallax: by what two cameras see of the box at good angles; auto: as the scene's files say, else points, else angle, or parallax where angle is blind"),
    Make::number("min-angle", AT(views.min_angle_deg), {0, 90}, "Least angle between views chosen by angle, degrees"),
    Make::number("max-angle", AT(views.max_angle_deg), {1, 180}, "Largest angle to a compared view, degrees"),
    Make::number("window", AT(sweep.window), {3, 15, true}, "Side of the compared windows, pixels"),
    Make::number("second-window", AT(sweep.second_window), {5, 15, true, true}, "Side of larger windows for pixels that find no depth, such as 9 for weak texture; 0: none"),
    Make::choice("window-model", AT(sweep.window_model), {{"slanted", WindowModel::kSlanted}, {"plane", WindowModel::kPlane}, {"axis", WindowModel::kAxis}}, "slanted: windows lie on the surface; plane: they follow the plane of the tested depth; axis: the paper's axis-aligned windows"),
    no_slant_option("As window-model plane"),
    Make::number("threshold", AT(sweep.threshold), {0, 0.99}, "Correlation from which on a view votes for a depth"),
    Make::number("min-votes", AT(sweep.min_votes), {1, 32}, "Votes that make a depth valid"),
    Make::length("depth-step", AT(sweep.depth_step), "Distance of depth samples, such as 2.5mm; auto: from step-pixels"),
    Make::number("step-pixels", AT(sweep.step_pixels), {.least = 0.05, .most = 8, .or_zero = true}, "Automatic step: largest motion in a compared view, pixels; 0: 2 for slanted windows, else 1"),
    Make::number("support-tolerance", AT(sweep.support_tolerance), {0, 255}, "Pixels of a slanted window whose colors differ by more from its center's are left out, as long as 9 of 25 stay; 255: none"),
    Make::toggle("half-size", AT(sweep.half_size), "No depths from images of half the size where those of full size give none"),
    Make::toggle("outside", AT(sweep.outside), "Keep depths in the box where something beyond it correlates better"),
    Make::number("refinement", AT(sweep.refinement), {1, 32}, "The second pass of plane and axis divides the step by this; 1: no second pass"),
    Make::number("mask-below", AT(mask_below), {0, 0.999}, "Leave out a background darker than this, 0 to 1 (0.19 for the dino); 0: keep all"),
  });
  add(RunStage::kConfirm, {
    Make::toggle("confirm", AT(confirm), "The paper's confidence alone: depths don't gain or lose by what other views' depth maps say"),
    Make::number("confirm-rounds", AT(confirm_rounds), {0, 8}, "Rounds in which depths are dropped that look through surer depths of other views; 0: they weigh less alone"),
    Make::number("min-patch", AT(min_patch), {}, "Leave out patches of a depth map that no other view confirms, of fewer pixels (at most a 1500th of the image); 0: keep all"),
    Make::number("max-slope", AT(fusion.max_slope_deg), {10, 89}, "Steepest triangle of a depth map, degrees"),
  });
  add(RunStage::kFusion, {
    Make::length("voxel-size", AT(fusion.voxel_size), "Edge of a voxel, such as 0.5mm; auto: a pixel's footprint"),
    Make::length("truncation", AT(fusion.truncation), "Distance from a surface up to which voxels are filled; auto: 3 voxels; 4 with ray"),
    Make::choice("signed-distance", AT(fusion.signed_distance), {{"normal", SignedDistance::kNormal}, {"ray", SignedDistance::kRay}}, "Along what voxels measure it: normal of the surface, or ray, the line of sight as in the paper"),
    Make::number("plane-agreement", AT(fusion.plane_agreement), {0, 100}, "Pixels' footprints that a neighbor may lie off a pixel's plane to be joined to it where the surface is steeper than 40 degrees; 0: any"),
    Make::number("feather", AT(fusion.feather), {0, 8}, "Pixels over which weights rise from a border"),
    weights_option("weights", "What a depth's weight is made of"),
    Make::toggle("fill-holes", AT(fusion.fill_holes), "Close holes by space carving, confidence 0 there; nothing is where masks and mask-below leave out pixels"),
  });
  add(RunStage::kClean, {
    Make::number_or_auto("min-confidence", AT(min_confidence), {}, "Drop triangles of less; 1 is one view that is fully confident; 0 keeps all"),
    Make::number("min-component", AT(clean.min_component_triangles), {}, "Drop pieces of fewer triangles, unless all have fewer"),
    Make::number("min-component-share", AT(clean.min_component_share), {0, 1}, "Drop pieces of fewer triangles than this share of the largest piece's, such as 0.01"),
    Make::toggle("largest-component", AT(clean.largest_component), "Keep the largest piece alone"),
    Make::choice("frame", AT(frame), {{"world", PlyFrame::kWorld}, {"local", PlyFrame::kLocal}}, "Coordinates of mesh, cloud and colmap/ of a scene far from its origin (UTM): world, in double; local: without the offset that run.json and the files' headers state"),
  });
  add(RunStage::kExtras, {
    Make::toggle("cloud", AT(cloud), "Also fuse the depth maps to a cloud of points, fused.ply"),
    Make::number("cloud-views", AT(cloud_views), {2, 33}, "Views that must agree on a point of the cloud"),
    Make::toggle("colmap", AT(colmap), "Also write colmap/, a dense workspace for `colmap stereo_fusion`"),
    Make::toggle("texture", AT(texture), "Also write model.glb: the mesh with the photographs on it (docs/texture.md)"),
    triangles_option("triangles", "Also write model.glb with no more triangles than this, as `quorum simplify` does; with texture the photographs are on it"),
  });
  add(RunStage::kNone, {
    Make::text("device", AT(device), "auto, cpu, an index or a part of a name", "What does the work, of what `quorum devices` lists"),
    Make::number("threads", AT(threads), {0, 1024}, "CPU threads; 0: all"),
    Make::size("memory", AT(memory_bytes), "What the run may hold in memory, such as 4GiB; auto: three quarters of what is free"),
    tile_option("tile", "Tile of the CPU sweep, width and height in pixels"),
    Make::choice("simd", AT(simd), {{"auto", std::nullopt}, {"baseline", SimdLevel::kBaseline}, {"avx2", SimdLevel::kAvx2}, {"avx512", SimdLevel::kAvx512}}, "Instructions of the sweep and the fusion on the CPU"),
  });
  add(RunStage::kFiles, {
    Make::choice("previews", AT(previews), {{"full", Previews::kFull}, {"small", Previews::kSmall}, {"none", Previews::kNone}}, "Pictures of the maps to look at: as large as these, at most 512 pixels wide, or none"),
    Make::choice("maps", AT(saved_maps), {{"all", SavedMaps::kAll}, {"needed", SavedMaps::kNeeded}, {"least", SavedMaps::kLeast}}, "Maps that are written. needed: what later stages and COLMAP may read; least: what this very run reads; all: correlation, too"),
  });
  add(RunStage::kShards, {
    shard_option("shard", "Work on this part alone; all parts, in any order and on any machines, then `quorum join`"),
  });
  // clang-format on
  return table;
}

#undef AT

/// What options must fit of each other.
Expected<void> check_together(const RunOptions& options) {
  const auto wrong = [](std::string_view option, auto value, const std::string& remedy) {
    return failure(ErrorKind::kUsage, fmt::format("{} {}: {}", option_name(option), value, remedy));
  };
  const FusionOptions& fusion = options.fusion;
  if (fusion.truncation > 0.0 && fusion.voxel_size > 0.0 &&
      (fusion.truncation < 1.5 * fusion.voxel_size || fusion.truncation > 32 * fusion.voxel_size))
    return wrong("truncation", fusion.truncation,
                 fmt::format("give 1.5 to 32 times the voxel size {}", fusion.voxel_size));
  const int second = options.sweep.second_window;
  if (second != 0 && second <= options.sweep.window)
    return wrong(
        "second-window", second,
        fmt::format("give an odd number above {} {}, up to 15, or 0", option_name("window"), options.sweep.window));
  if (options.sweep.min_votes > options.views.neighbor_count)
    return wrong("min-votes", options.sweep.min_votes,
                 fmt::format("can't exceed {} {}", option_name("neighbors"), options.views.neighbor_count));
  if (options.simd > best_simd_level()) return wrong("simd", "level", "this processor does not have it; give auto");
  return {};
}

}  // namespace

const std::vector<RunOption>& run_option_table() {
  static const std::vector<RunOption> kTable = make_table();
  return kTable;
}

std::string_view stage_heading(RunStage stage) {
  switch (stage) {
    case RunStage::kScene:
      return "Scene";
    case RunStage::kDepth:
      return "Depth maps (the paper, sections 2.1 and 4.1)";
    case RunStage::kConfirm:
    case RunStage::kFusion:
    case RunStage::kClean:
      return "Fusion and mesh (the paper, section 2.2)";
    case RunStage::kExtras:
      return "Files beside the mesh";
    case RunStage::kFiles:
      return "Files of each view";
    case RunStage::kShards:
      return "Clusters (`depth`, `confirm` and `fuse`)";
    case RunStage::kNone:
      break;
  }
  return "Device (results are the same on every device)";
}

Expected<void> RunOptions::check() const {
  for (const RunOption& option : run_option_table())
    if (!option.holds(*this)) return option.refuse(option.text(*this));
  return check_together(*this);
}

SavedFiles RunOptions::saved_files() const {
  const bool least = saved_maps == SavedMaps::kLeast;
  const bool takes_normals = fusion.plane_agreement > 0 || cloud || colmap;
  return {saved_maps == SavedMaps::kAll, !least || !confirm, !least || takes_normals, previews};
}

std::string run_options_markdown() {
  std::string page;
  std::string_view heading;
  for (const RunOption& option : run_option_table()) {
    if (stage_heading(option.stage) != heading) {
      heading = stage_heading(option.stage);
      page += fmt::format("\n## {}\n\n| option | takes | default | what for |\n|---|---|---|---|\n", heading);
    }
    const std::string usual = option.most_words == 0 ? "" : option.text(RunOptions{});
    page += fmt::format("| `--{}` | {} | {} | {} |\n", option.given_name(), option.values, usual, option.help);
  }
  return page;
}

}  // namespace quorum
