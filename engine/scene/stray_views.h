// Cameras that stand nowhere near the others, as a pose that went wrong puts them.
#pragma once

#include <vector>

#include "engine/scene/scene.h"

namespace quorum {

/// The views, ascending, that stand more than `far` times as far from the middle of all centers (the median of each
/// coordinate) as the nearest two thirds of the views do. None where these stand in one point.
std::vector<int> stray_views(const Scene& scene, double far);

/// The scene without these views (ascending), which neighbors and points forget; is_copy is forgotten everywhere.
void leave_out(Scene& scene, const std::vector<int>& views);

}  // namespace quorum
