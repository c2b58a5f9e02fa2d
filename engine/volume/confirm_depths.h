// Geometric confirmation: what other views' depth maps say of the depths of a view. Twin of
// shaders/confirm_depths.comp.
//
// Each depth is a point in space. Another view supports it if the surface of its own depth map passes there, and speaks
// against it if it looks through the point at something behind. A view that sees something in front of the point, or
// has no depth there, says nothing. How often depths of a given support were right on scenes with known surface gives
// the certainty: docs/quality.md. The idea is old; see P. Merrell et al., Real-Time Visibility-Based Fusion of Depth
// Maps, ICCV 2007.
//
// Where two views contradict each other, the less certain one is wrong, as a rule. In rounds after the first a depth is
// denied if what another view sees in front of it lies where the view itself looks through, and is more certain than
// the depth. A denied depth takes no part any more: its certainty is 0.
#pragma once

#include <memory>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/grid.h"
#include "engine/core/simd.h"
#include "engine/depth/depth_map.h"
#include "engine/volume/fusion_options.h"
#include "shaders/layout.h"

namespace quorum {

/// Most other views that a view's depths are compared with.
constexpr int kConfirmingViews = 6;

/// A view's depths with its camera.
struct ViewDepths {
  Grid<float> depth;  ///< scene units; 0 = none, or denied in a round before
  Camera camera;
  Grid<float> certainty = {};  ///< of the round before, of depth's size; empty in the first
};

/// A view whose depths are confirmed, and the others, at most kConfirmingViews; shared, since each confirms several.
struct ConfirmTask {
  std::shared_ptr<const ViewDepths> view;
  std::vector<std::shared_ptr<const ViewDepths>> others;
  FusionOptions fusion;  ///< max_slope_deg: between the pixels of an other view's surface
};

ConfirmDepthsParams make_confirm_depths_params(const ConfirmTask& task, std::size_t other);

/// Adds to the support of each depth of a view what one other view says: kSupportOfAgreement if its depth at the
/// point's projection lies within kAgreement footprints of a pixel, as much again if within kCloseAgreement, and
/// kSupportOfLookingThrough if it lies more than kLooksThrough behind. The other depth is interpolated where its cell
/// has no step, and that of the nearest pixel elsewhere. kSupportOfDenial if both have certainties and the other's
/// nearest depth lies more than kLooksThrough in front of the point, is more certain, and projects into a cell of the
/// view whose depths lie all more than kLooksThrough behind it. 0 where the view has no depth. support: of the view's
/// size.
void confirm_depths(const ViewDepths& view, const ViewDepths& other, const ConfirmDepthsParams& params, SimdLevel simd,
                    Grid<int>& support);

/// The share of depths of this support that lay within a pixel's footprint of the true surface; in 1/256, 0..1. 0 of
/// one that was denied.
float certainty_of(int support);

/// The certainty of each depth from its support; 0 where there is no depth.
Grid<float> certainty_map(const Grid<float>& depth, const Grid<int>& support);

/// The certainty of a view's depths, on the CPU. Equal at every SIMD level.
Grid<float> confirm_depths(const ConfirmTask& task, SimdLevel simd = best_simd_level());

}  // namespace quorum
