// A triangle mesh (or, without triangles, a cloud) with what is known of each vertex.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/image/image.h"

namespace quorum {

struct Vertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< world, scene units
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit length, away from the solid; zero if unknown
  Rgba color = make_rgb(128, 128, 128);
  float confidence = 0.0F;  ///< accumulated weight: 1 = one view that is fully confident; 0 = unknown
};

/// Triangles list their corners counterclockwise as seen from outside.
struct Mesh {
  std::vector<Vertex> vertices = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< files' coordinates = positions + offset
};

}  // namespace quorum
