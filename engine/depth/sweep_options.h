// Options of the depth stages. The defaults were chosen by the experiments of docs/paper.md, where window, min_votes
// and refinement stand under these names; threshold and step_pixels depart from the paper. Slanted windows:
// docs/quality.md.
#pragma once

namespace quorum {

/// What a window in the neighbor looks like.
enum class WindowModel {
  kSlanted,  ///< follows the plane at the tested depth, then a tilted plane that is found instead of a second pass
  kPlane,    ///< follows the fronto-parallel plane at the tested depth; also right for rotated neighbors
  kAxis,     ///< the paper's: as many pixels, axis-aligned, around the projection
};

struct SweepOptions {
  int window = 5;            ///< side of the window, pixels, odd, 3..15 (paper 4.2)
  float threshold = 0.5F;    ///< NCC above which a neighbor votes for a depth, 0..0.99; the paper: 0.6 (4.1)
  int min_votes = 2;         ///< votes that make a depth valid, 1..32 (paper 2.1)
  bool outside = true;       ///< slanted windows may prefer a plane beyond the bounds; such pixels have no depth
  bool half_size = true;     ///< images of half the size give slanted windows a depth where full ones find none
  double depth_step = 0.0;   ///< distance of depth samples, scene units (the paper's 2.5 mm); 0 = automatic
  double step_pixels = 0.0;  ///< automatic step: largest motion of the projection in a neighbor, pixels, 0.05..8;
                             ///< 0 = automatic: 2 if planes are refined after the first pass, else 1
  int refinement = 10;       ///< the second pass samples at 1 / refinement of the step; 1 = no second pass (paper 4.1)
  WindowModel window_model = WindowModel::kSlanted;
  int second_window = 0;       ///< side of larger windows where these find no depth, odd, up to 15; 0 = none
  int support_tolerance = 15;  ///< of slanted windows, see make_support_windows(), 0..255; 255 = whole windows

  [[nodiscard]] bool is_slanted() const { return window_model == WindowModel::kSlanted; }
  [[nodiscard]] bool is_along_axes() const { return window_model == WindowModel::kAxis; }

  /// The step that step_pixels asks for.
  [[nodiscard]] double automatic_step_pixels() const {
    if (step_pixels > 0.0) return step_pixels;
    return is_slanted() ? 2.0 : 1.0;
  }
};

}  // namespace quorum
