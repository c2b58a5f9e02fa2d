// What hides what in a photograph: a depth buffer in integers, the same on every machine (Embree promises no bytes).
#pragma once

#include "engine/core/grid.h"
#include "engine/texture/project_mesh.h"

namespace quorum {

struct NearnessBuffer {
  Grid<std::uint32_t> largest;   ///< within a pixel of each, along x and y
  Grid<std::uint32_t> smallest;  ///< within three pixels
};

/// Per pixel the nearness of the surface that is nearest to the camera around it; 0 where there is none. Both sides of
/// a triangle hide what is behind it.
NearnessBuffer nearness_buffer(const Mesh& mesh, const ProjectedMesh& projected, int width, int height);

}  // namespace quorum
