// Views of large photographs, made smaller.
#pragma once

#include "engine/scene/scene.h"

namespace quorum {

/// Halves the images of all views that are wider or higher than max_size pixels (>= 1) until they are not, and their
/// cameras with them. What is left of an odd size is cut off.
void limit_image_size(Scene& scene, int max_size);

}  // namespace quorum
