#include "engine/mesh/case_table.h"

#include "engine/core/check.h"

namespace quorum {
namespace {

using Loop = std::vector<int>;  // edge numbers

/// Corners of the six faces, counterclockwise as seen from outside the cube.
constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

int edge_between(int a, int b) {
  for (int edge = 0; edge < 12; ++edge) {
    const CubeEdge& candidate = cube_edges()[static_cast<std::size_t>(edge)];
    const int other = candidate.corner | 1 << candidate.axis;
    if ((candidate.corner == a && other == b) || (candidate.corner == b && other == a)) return edge;
  }
  fail_check(__FILE__, __LINE__, "corners share an edge", a, b);
}

bool share_face(int edge_a, int edge_b) {
  const auto face_mask = [](int edge) {
    int mask = 0;
    for (int face = 0; face < 6; ++face)
      for (int side = 0; side < 4; ++side)
        if (edge_between(kFaces[face][side], kFaces[face][(side + 1) % 4]) == edge) mask |= 1 << face;
    return mask;
  };
  return (face_mask(edge_a) & face_mask(edge_b)) != 0;
}

/// The closed loops of edges that separate inside corners from outside ones.
std::vector<Loop> trace_loops(int inside) {
  const auto is_inside = [&](int corner) { return (inside >> corner & 1) != 0; };
  std::array<int, 12> next;
  next.fill(-1);
  for (const auto& face : kFaces) {
    for (int side = 0; side < 4; ++side) {
      if (is_inside(face[side]) || !is_inside(face[(side + 1) % 4])) continue;
      int end = side + 1;
      while (is_inside(face[(end + 1) % 4])) ++end;
      // From where the inside run begins to where it ends, seen from outside the cube: the loops then run
      // counterclockwise as seen from outside the solid.
      next[static_cast<std::size_t>(edge_between(face[side], face[(side + 1) % 4]))] =
          edge_between(face[end % 4], face[(end + 1) % 4]);
    }
  }
  std::vector<Loop> loops;
  for (int start = 0; start < 12; ++start) {
    Loop loop;
    for (int edge = start; next[static_cast<std::size_t>(edge)] >= 0;) {
      loop.push_back(edge);
      const int following = next[static_cast<std::size_t>(edge)];
      next[static_cast<std::size_t>(edge)] = -1;
      edge = following;
    }
    if (!loop.empty()) loops.push_back(loop);
  }
  return loops;
}

/// Splits loop[first..last] into triangles without a diagonal in a face; false if there is no such way.
bool split_loop(const Loop& loop, std::size_t first, std::size_t last, std::vector<std::array<std::uint8_t, 3>>& out) {
  if (last - first < 2) return true;
  const auto allowed = [&](std::size_t a, std::size_t b) {
    return b - a == 1 || b - a == loop.size() - 1 || !share_face(loop[a], loop[b]);
  };
  for (std::size_t middle = first + 1; middle < last; ++middle) {
    if (!allowed(first, middle) || !allowed(middle, last)) continue;
    const std::size_t mark = out.size();
    out.push_back({static_cast<std::uint8_t>(loop[first]), static_cast<std::uint8_t>(loop[middle]),
                   static_cast<std::uint8_t>(loop[last])});
    if (split_loop(loop, first, middle, out) && split_loop(loop, middle, last, out)) return true;
    out.resize(mark);
  }
  return false;
}

CaseTable generate_table() {
  CaseTable table;
  for (int inside = 0; inside < 256; ++inside) {
    for (const Loop& loop : trace_loops(inside)) {
      const bool split = split_loop(loop, 0, loop.size() - 1, table[static_cast<std::size_t>(inside)]);
      QUORUM_CHECK_EQ(split, true);
    }
  }
  return table;
}

}  // namespace

const std::array<CubeEdge, 12>& cube_edges() {
  static const std::array<CubeEdge, 12> kEdges = [] {
    std::array<CubeEdge, 12> edges;
    std::size_t count = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int corner = 0; corner < 8; ++corner)
        if ((corner >> axis & 1) == 0) edges[count++] = {corner, axis};
    return edges;
  }();
  return kEdges;
}

const CaseTable& case_table() {
  static const CaseTable kTable = generate_table();
  return kTable;
}

}  // namespace quorum
