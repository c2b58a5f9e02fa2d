// Which neighbor views a reference view is compared with: the rule of the paper, section 4.1, and, where sparse points
// are known or sampled, that of M. Goesele, N. Snavely, B. Curless, H. Hoppe, S. M. Seitz: Multi-View Stereo for
// Community Photo Collections, ICCV 2007, section 4.
#pragma once

#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

enum class ViewRule {
  kAutomatic,  ///< the first of these that gives two: what the scene's files name, points, angle where it has parallax,
               ///< parallax
  kAngle,      ///< closest optical axes (the paper)
  kPoints,     ///< most shared points at good angles and a like resolution
  kParallax,   ///< as kPoints, with points on the rays of the reference: for views without sparse points
};

struct SelectViewsOptions {
  ViewRule rule = ViewRule::kAutomatic;
  int neighbor_count = 4;       ///< k, 2..32
  double min_angle_deg = 4.0;   ///< rule kAngle: least angle of a neighbor to the reference and to each other, 0..90
  double max_angle_deg = 90.0;  ///< views turned away further can't see the same side, 1..180 (not in the paper)
};

/// Neighbors of scene.views[reference]; may be fewer than neighbor_count. With fewer than two no depth can be found.
/// But for kAngle, two views without parallax (least_parallax_deg) are never neighbors, and of several views with one
/// content from one place (is_copy) the first alone counts: the others are nobody's neighbors, and have none.
///
/// kAngle: closest first by the angle between the optical axes; of views at the same angle the one that comes first in
/// the scene. Views are taken in that order unless they are closer than min_angle_deg to the reference or to one
/// already taken.
///
/// kPoints: one view after the other, each time the one of the highest score, the sum over the points that it shares
/// with the reference of min(1, (angle / 10 deg)^2), where the angle is that of the two rays at the point, times as
/// much for each view already taken that sees the point, times the ratio of the resolutions at the point, where the
/// neighbor is coarser or more than twice as fine. Points seen at more than max_angle_deg don't count, and views of
/// less than a fiftieth of the first one's score are not taken.
///
/// kParallax: select_by_parallax.
///
/// kAutomatic takes the views of kAngle, where files and points give none, if they are not blind: parallel axes, or
/// views from one place, show no depth, and then kParallax is asked.
std::vector<int> select_views(const Scene& scene, int reference, const SelectViewsOptions& options);

/// What to say if no view has two neighbors (kInput): whether the photographs are from one place, or show too little in
/// common, and the remedy.
Error no_neighbors_error(const Scene& scene, const SelectViewsOptions& options);

}  // namespace quorum
