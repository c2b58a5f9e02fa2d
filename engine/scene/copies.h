// Views that repeat others: a photograph twice in a folder, or one more from the same place, is no evidence of its own.
#pragma once

#include <vector>

#include "engine/scene/parallax.h"

namespace quorum {

/// True if the view shows what the earlier one does, from its place: less parallax than least_parallax_deg, nine tenths
/// of the points seen, a like resolution. Such a view is no evidence of its own. points: sample_rays of the view.
bool repeats(const View& view, const std::vector<RayPoint>& points, const View& earlier);

/// True if the view repeats an earlier one of the scene that does not repeat another itself.
bool is_copy(const Scene& scene, int view);
/// Says so of all views once, in View::is_copy, so that nobody has to look at all pairs again. What changes cameras or
/// bounds after that has to do it again.
void mark_copies(Scene& scene);

}  // namespace quorum
