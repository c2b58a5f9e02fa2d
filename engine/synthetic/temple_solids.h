// The synthetic temple as a list of solids: three steps, columns, a cella, an entablature and a roof, about as large as
// the plaster temple of the Middlebury sets. No two sides are alike: a column is broken, a buttress and an altar stand
// on one side only, and triglyphs decorate two of the four sides.
#pragma once

#include <span>

#include "engine/core/bounds.h"
#include "engine/synthetic/shapes.h"

namespace quorum {

/// All solids, in meters, y up, standing on y = 0. They touch, but never reach into one another.
std::span<const Solid> temple_solids();

/// The smallest box around all solids.
Bounds temple_bounds();

}  // namespace quorum
