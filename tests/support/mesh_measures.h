// What tests ask of a mesh as a whole.
#pragma once

#include "engine/mesh/mesh.h"

namespace quorum {

struct MeshMeasures {
  bool closed = true;  ///< every edge belongs to exactly two triangles, which run along it in opposite directions
  double area = 0.0;
  double volume = 0.0;           ///< positive if triangles are counterclockwise as seen from outside
  int euler_characteristic = 0;  ///< vertices - edges + triangles; 2 for a sphere
};

MeshMeasures measure_mesh(const Mesh& mesh);

/// True if both have the same bytes.
bool same_mesh(const Mesh& a, const Mesh& b);

}  // namespace quorum
