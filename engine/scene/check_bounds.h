// Whether the bounds of a scene can be right.
#pragma once

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Fails (kInput) if the bounds are empty or not finite, or if no view sees them; the message gives the bounds and the
/// remedy.
Expected<void> check_bounds(const Scene& scene);

}  // namespace quorum
