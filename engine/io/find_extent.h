// Bounds and depth ranges of a scene whose files give none.
#pragma once

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Sets the bounds: find_bounds, and where that knows none, those of the points of a coarse_sweep, which also give
/// depth ranges. The points themselves are not kept. Without points, cameras thirty times as far away as the others
/// reach (stray_views), or five times where nothing is found with them, are left out if the others have an extent,
/// which a note tells. Fails (kInput) if nothing is found, or a photograph can't be read.
Expected<void> find_extent(Scene& scene);

/// Sets the depth ranges of the views whose cameras stand in the bounds, where the box says little, to those of the
/// points of a coarse_sweep. Without enough of them the views keep what they have. Fails if a photograph can't be read.
Expected<void> find_ranges_inside(Scene& scene);

}  // namespace quorum
