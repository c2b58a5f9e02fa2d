// Where a mesh is open, and which photographs look into the openings: what is missing, and what would close it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/grid.h"
#include "engine/mesh/mesh.h"
#include "engine/scene/scene.h"

namespace quorum {

/// An opening: edges with one triangle that hang together by their vertices. Where the surface is cut by the bounds
/// there is none.
struct Hole {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< mean of its edges, world
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit; out of this direction one looks into it
  double diameter = 0;                               ///< largest extent along an axis, scene units
  std::vector<std::array<std::uint32_t, 2>> edges;   ///< vertices, in the order of their triangles
  std::vector<int> seen_by;                          ///< views that look into it, ascending
  std::vector<int> nearest;                          ///< at most two views, on different sides of the normal
};

/// The openings of a mesh that are wider than a share of its diagonal, widest first, at most `most`; seen_by and
/// nearest are left empty.
std::vector<Hole> find_holes(const Mesh& mesh, const Bounds& bounds, double least_share = 0.03, std::size_t most = 12);

/// Reads the depth map of a view; 0 = no depth.
using ReadDepth = std::function<Expected<Grid<float>>(int view)>;

/// Fills seen_by and nearest: a view looks into a hole if the middle lies in its image, less than 75 degrees off the
/// normal, and no depth of the view hides it. Fails as read does.
Expected<void> find_views(const Scene& scene, const ReadDepth& read, std::vector<Hole>& holes);

/// Angle between the normal of a hole and the direction from it to a view, degrees.
double angle_to_view(const Hole& hole, const View& view);

}  // namespace quorum
