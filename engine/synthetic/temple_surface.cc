// The exact surface of the temple: the triangles of all solids, less those that no light can reach.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "engine/core/check.h"
#include "engine/synthetic/temple.h"
#include "engine/synthetic/temple_solids.h"
#include "engine/synthetic/tessellate.h"

namespace quorum {

namespace {

constexpr double kOutward = 1e-6;    ///< how far outside a face the light is asked for, meters
constexpr double kTolerance = 1e-7;  ///< above the rounding of positions to float, below kOutward, meters

std::vector<Solid> solids_touching(const Solid& solid) {
  const Bounds reach = bounds_of(solid).expanded(kOutward);
  std::vector<Solid> touching;
  for (const Solid& other : temple_solids()) {
    const Bounds bounds = bounds_of(other);
    const bool self = &other == &solid;
    if (!self && (bounds.low.array() <= reach.high.array()).all() && (bounds.high.array() >= reach.low.array()).all())
      touching.push_back(other);
  }
  return touching;
}

/// Rectangles are divided where their neighbors end, so that a triangle is covered wholly or not at all.
Cuts cuts_at(const std::vector<Solid>& touching) {
  Cuts cuts;
  for (const Solid& other : touching) {
    const Bounds bounds = bounds_of(other);
    for (std::size_t axis = 0; axis < 3; ++axis)
      cuts[axis].insert(cuts[axis].end(), {bounds.low[static_cast<int>(axis)], bounds.high[static_cast<int>(axis)]});
  }
  return cuts;
}

/// Solids are convex: what covers the corners of a triangle covers all of it.
bool covers(const Solid& solid, const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return std::ranges::all_of(triangle, [&](std::uint32_t corner) {
    const Vertex& vertex = mesh.vertices[corner];
    return contains(solid, vertex.position.cast<double>() + kOutward * vertex.normal.cast<double>(), kTolerance);
  });
}

bool on_ground(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return std::ranges::all_of(triangle, [&](std::uint32_t corner) {
    return mesh.vertices[corner].position.y() == 0 && mesh.vertices[corner].normal.y() < 0;
  });
}

/// Appends a triangle and those of its vertices that have no place in the mesh yet.
void append(Mesh& mesh, const Mesh& part, const std::array<std::uint32_t, 3>& triangle,
            std::vector<std::uint32_t>& place_of_vertex) {
  std::array<std::uint32_t, 3> placed{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint32_t& place = place_of_vertex[triangle[i]];
    if (place == std::numeric_limits<std::uint32_t>::max()) {
      place = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(part.vertices[triangle[i]]);
    }
    placed[i] = place;
  }
  mesh.triangles.push_back(placed);
}

}  // namespace

Mesh temple_surface(double max_edge) {
  constexpr double kSmallestEdge = 1e-4;
  QUORUM_CHECK_GE(max_edge, kSmallestEdge);
  Mesh surface;
  for (const Solid& solid : temple_solids()) {
    const std::vector<Solid> touching = solids_touching(solid);
    const Mesh part = tessellate(solid, max_edge, cuts_at(touching));
    std::vector<std::uint32_t> place_of_vertex(part.vertices.size(), std::numeric_limits<std::uint32_t>::max());
    for (const auto& triangle : part.triangles) {
      const bool hidden = on_ground(part, triangle) || std::ranges::any_of(touching, [&](const Solid& other) {
                            return covers(other, part, triangle);
                          });
      if (!hidden) append(surface, part, triangle, place_of_vertex);
    }
  }
  return surface;
}

}  // namespace quorum
