// Which neighbor views a reference view is compared with: the rule of the paper, section 4.1.
#pragma once

#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

struct SelectViewsOptions {
  int neighbor_count = 4;       ///< k, 2..32
  double min_angle_deg = 4.0;   ///< least angle of a neighbor to the reference and to each other, 0..90
  double max_angle_deg = 90.0;  ///< views turned away further can't see the same side, 1..180 (not in the paper)

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
};

/// Neighbors of scene.views[reference], closest first by the angle between the optical axes; of views at the same angle
/// the one that comes first in the scene. Views are taken in that order unless they are closer than min_angle_deg to
/// the reference or to one already taken. May hold fewer than neighbor_count; with fewer than two no depth can be
/// found.
std::vector<int> select_views(const Scene& scene, int reference, const SelectViewsOptions& options);

}  // namespace quorum
