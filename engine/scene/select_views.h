// Which neighbor views a reference view is compared with: the rule of the paper, section 4.1, and, where sparse points
// are known, that of M. Goesele, N. Snavely, B. Curless, H. Hoppe, S. M. Seitz: Multi-View Stereo for Community Photo
// Collections, ICCV 2007, section 4.
#pragma once

#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

enum class ViewRule {
  kAutomatic,  ///< the neighbors that the scene's files name, else by points where the scene has some, else by angle
  kAngle,      ///< closest optical axes (the paper)
  kPoints,     ///< most shared points at good angles and a like resolution
};

struct SelectViewsOptions {
  ViewRule rule = ViewRule::kAutomatic;
  int neighbor_count = 4;       ///< k, 2..32
  double min_angle_deg = 4.0;   ///< rule kAngle: least angle of a neighbor to the reference and to each other, 0..90
  double max_angle_deg = 90.0;  ///< views turned away further can't see the same side, 1..180 (not in the paper)

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
};

/// Neighbors of scene.views[reference]; may be fewer than neighbor_count. With fewer than two no depth can be found.
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
std::vector<int> select_views(const Scene& scene, int reference, const SelectViewsOptions& options);

}  // namespace quorum
