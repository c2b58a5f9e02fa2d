// The frame that the engine works in. Scenes in UTM or earth-centered coordinates lie so far from their origin that
// single precision loses centimeters; an offset near their middle is taken off as they are read, in double, and put
// back as results are written. Nothing but positions depends on it, so a scene that is moved gives the same surface.
#pragma once

#include "engine/scene/scene.h"

namespace quorum {

/// The offset to take off what lies around `middle` and reaches about `extent` far from it, scene units: zero if the
/// origin is near enough for single precision, or all lies in one place, else a round number near the middle.
Eigen::Vector3d far_offset(const Eigen::Vector3d& middle, double extent);

/// Takes the offset off a scene as its files give it, cameras and points, and adds it to Scene::offset. Bounds are not
/// touched: they are not known yet.
void enter_local_frame(Scene& scene);

/// A box of the scene's files, or of its user, in the frame of the scene.
Bounds in_local_frame(const Bounds& box, const Scene& scene);

/// The scene in the coordinates of its files, without an offset.
Scene in_world(Scene scene);

}  // namespace quorum
