// A mesh in few bytes, for a page.
#pragma once

#include <string>
#include <vector>

#include "engine/mesh/mesh.h"

namespace quorum {

/// Little-endian arrays in base64. A position is low + value / 65535 * size; colors are sRGB; a confidence of 255 is
/// full_confidence or more.
struct PackedMesh {
  std::string positions;   ///< uint16 x 3 a vertex
  std::string colors;      ///< uint8 x 3
  std::string confidence;  ///< uint8
  std::string views;       ///< uint8, how many views measured it
  std::string triangles;   ///< uint32 x 3
  Eigen::Vector3f low = Eigen::Vector3f::Zero();
  Eigen::Vector3f size = Eigen::Vector3f::Zero();
};

/// views: per vertex. full_confidence > 0.
PackedMesh pack_mesh(const Mesh& mesh, const std::vector<int>& views, float full_confidence);

}  // namespace quorum
