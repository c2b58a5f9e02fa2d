// Points spread over a surface, for measuring shares of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/mesh/mesh.h"

namespace quorum {

/// Points on a mesh, spread by area: the triangles are laid out along a line of their areas, the line is cut into as
/// many equal pieces as there are samples, and each piece gives one point. So a part of the surface gets its share
/// within one sample however its triangles are cut, and triangles without area get none (if all are such, each counts
/// the same). A cloud is returned point by point; samples and seed then say nothing. Empty for an empty mesh. Cannot
/// fail; the same points for the same arguments.
std::vector<Eigen::Vector3d> sample_surface(const Mesh& surface, std::uint64_t samples, std::uint64_t seed);

}  // namespace quorum
