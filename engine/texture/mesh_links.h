// Which triangles lie around a vertex, and side by side.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"

namespace quorum {

constexpr std::uint32_t kNoTriangle = 0xffffffffU;

struct MeshLinks {
  std::vector<std::uint32_t> first = {};   ///< per vertex, and at the end: where its triangles begin in `around`
  std::vector<std::uint32_t> around = {};  ///< ascending for each vertex
  std::vector<std::array<std::uint32_t, 3>> neighbors =
      {};  ///< per triangle: across the edge that begins at each corner

  [[nodiscard]] std::span<const std::uint32_t> around_vertex(std::uint32_t vertex) const {
    return std::span(around).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

/// Neighbors share an edge that no third triangle has.
MeshLinks link_mesh(const Mesh& mesh);

}  // namespace quorum
