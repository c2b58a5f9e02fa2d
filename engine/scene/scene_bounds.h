// Where the object is, and how far from each view, where no file says so.
#pragma once

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The box of the scene's points that three views see (two, if there are hardly any of three): along each axis from the
/// 1st to the 99th percentile, but no further from the middle half of the points than three times its length, so that a
/// quarter of outliers moves it little; and 5 % of its longest side more on all sides. Without points: the box of what
/// at least half of the views see (three, where views have a depth range), between these depths or about as far as
/// their optical axes meet, if three quarters of the views show that place. Follows the scene's scale. Fails (kInput)
/// if the views have no common field of view.
Expected<Bounds> find_bounds(const Scene& scene);

/// Sets the depth range of every view that sees at least 20 points within the bounds: from the 1st percentile of their
/// depths to the 99th, and a quarter of it more at either end. Other views keep what they have.
void find_depth_ranges(Scene& scene);

}  // namespace quorum
