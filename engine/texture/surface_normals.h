// Which way a surface faces where its triangles are smaller than its noise.
#pragma once

#include <vector>

#include "engine/scene/scene.h"
#include "engine/texture/mesh_links.h"

namespace quorum {

/// A triangle, and where the surface around it faces.
struct SurfacePiece {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< scene units
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit length, outward; zero if unknown
  float area = 0;                                    ///< scene units²
};

constexpr double kLeastFacing = 0.05;  ///< cosine from which on a surface faces a camera

/// Cosine of the angle between its normal and the way to a camera; 0 if the normal is unknown.
double cosine_to(const SurfacePiece& piece, const Eigen::Vector3d& camera_center);

/// How many steps of neighbors lie within some two pixels of the scene's photographs, 0 to 12: 0 where triangles are
/// large, so that edges of a simple shape stay edges.
int smoothing_steps(const Mesh& mesh, const Scene& scene);

/// Normals by area, each the mean of those of its own and of triangles up to `steps` away, the far ones least.
std::vector<SurfacePiece> surface_pieces(const Mesh& mesh, const MeshLinks& links, int steps);

}  // namespace quorum
