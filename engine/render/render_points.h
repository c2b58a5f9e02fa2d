// A picture of a cloud of points as a camera sees it, for looking at results.
#pragma once

#include "engine/render/render.h"

namespace quorum {

/// The vertices of a mesh, whatever its triangles, as squares of 1.5 pixels on white; the nearest hides the others. The
/// picture has width × height pixels (>= 0), each the mean of 2 × 2 samples. Points that turn away from the camera are
/// tinted blue as the back of a surface is; those without normal are taken to face it. Points that are not finite, or
/// behind the camera, are left out. Fails (kUsage) on options out of range.
Expected<ColorImage> render_points(const Mesh& cloud, const Camera& camera, int width, int height,
                                   const RenderOptions& options);

}  // namespace quorum
