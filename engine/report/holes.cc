#include "engine/report/holes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/mesh/disjoint_sets.h"

namespace quorum {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// Edges that one triangle has and no other, as it runs along them.
std::vector<Edge> open_edges(const Mesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& [a, b, c] : mesh.triangles)
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) edges.push_back(edge);
  const auto undirected = [](const Edge& edge) { return std::minmax(edge[0], edge[1]); };
  std::ranges::sort(edges, {},
                    [&](const Edge& edge) { return std::pair<std::uint32_t, std::uint32_t>(undirected(edge)); });
  std::vector<Edge> open;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && undirected(edges[end]) == undirected(edges[begin])) ++end;
    if (end == begin + 1) open.push_back(edges[begin]);
    begin = end;
  }
  return open;
}

/// Within a hundredth of the bounds' diagonal of one of their faces.
bool is_at_bounds(const Eigen::Vector3d& point, const Bounds& bounds) {
  const double margin = 0.01 * bounds.size().norm();
  return ((point - bounds.low).array() < margin).any() || ((bounds.high - point).array() < margin).any();
}

/// Center, normal and diameter from the edges. The normal is that of the patch that would close it: the sum of the
/// areas that the edges span with the center, backwards, since a triangle of the surface has its edge on the other
/// side.
void measure(const Mesh& mesh, Hole& hole) {
  const auto position = [&](std::uint32_t index) { return mesh.vertices[index].position.cast<double>().eval(); };
  Eigen::Vector3d low = position(hole.edges[0][0]);
  Eigen::Vector3d high = low;
  double length = 0;
  for (const auto& [a, b] : hole.edges) {
    const double edge = (position(b) - position(a)).norm();
    hole.center += 0.5 * edge * (position(a) + position(b));
    length += edge;
    low = low.cwiseMin(position(a)).cwiseMin(position(b));
    high = high.cwiseMax(position(a)).cwiseMax(position(b));
  }
  hole.center = length > 0 ? Eigen::Vector3d(hole.center / length) : low;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (const auto& [a, b] : hole.edges) area -= 0.5 * (position(a) - hole.center).cross(position(b) - hole.center);
  hole.normal = area.norm() > 0 ? area.normalized() : Eigen::Vector3d::UnitZ();
  hole.diameter = (high - low).maxCoeff();
}

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) * 180 / std::numbers::pi;
}

bool looks_into(const View& view, const Grid<float>& depth, const Hole& hole) {
  constexpr double kHidden = 0.98;  // of the depth of what it hides, at most
  if (angle_to_view(hole, view) > 75) return false;
  const Eigen::Vector3d pixel = view.camera.project(hole.center);
  if (pixel.z() <= 0) return false;
  const auto x = std::lround(std::clamp(pixel.x(), -1.0, 1e6));
  const auto y = std::lround(std::clamp(pixel.y(), -1.0, 1e6));
  if (!depth.contains(static_cast<int>(x), static_cast<int>(y))) return false;
  const auto before = static_cast<double>(depth.at(static_cast<int>(x), static_cast<int>(y)));
  return before <= 0 || before > kHidden * pixel.z();
}

/// The view nearest to the normal, and the nearest of those that lie on its other side, if any does.
std::vector<int> nearest_views(const Scene& scene, const Hole& hole) {
  const auto side = [&](int view) {
    const Eigen::Vector3d to = scene.views[view].camera.center() - hole.center;
    return Eigen::Vector3d(to.normalized() - to.normalized().dot(hole.normal) * hole.normal);
  };
  std::vector<int> order(scene.views.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::ranges::stable_sort(order, {}, [&](int view) { return angle_to_view(hole, scene.views[view]); });
  std::vector<int> nearest;
  for (const int view : order) {
    if (nearest.empty() || (nearest.size() == 1 && side(view).dot(side(nearest[0])) < 0)) nearest.push_back(view);
  }
  return nearest;
}

}  // namespace

std::vector<Hole> find_holes(const Mesh& mesh, const Bounds& bounds, double least_share, std::size_t most) {
  std::vector<Edge> open = open_edges(mesh);
  std::erase_if(open, [&](const Edge& edge) {
    return std::ranges::all_of(
        edge, [&](std::uint32_t index) { return is_at_bounds(mesh.vertices[index].position.cast<double>(), bounds); });
  });
  DisjointSets sets(mesh.vertices.size());
  for (const auto& [a, b] : open) sets.join(a, b);
  std::map<std::uint32_t, Hole> by_set;
  for (const Edge& edge : open) by_set[sets.find(edge[0])].edges.push_back(edge);

  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : mesh.vertices) box.extend(vertex.position);
  std::vector<Hole> holes;
  for (auto& [set, hole] : by_set) {
    measure(mesh, hole);
    if (hole.diameter >= least_share * static_cast<double>(box.diagonal().norm())) holes.push_back(std::move(hole));
  }
  std::ranges::stable_sort(holes, std::greater(), &Hole::diameter);
  if (holes.size() > most) holes.resize(most);
  return holes;
}

double angle_to_view(const Hole& hole, const View& view) {
  return degrees_between(view.camera.center() - hole.center, hole.normal);
}

Expected<void> find_views(const Scene& scene, const ReadDepth& read, std::vector<Hole>& holes) {
  for (std::size_t i = 0; i < scene.views.size() && !holes.empty(); ++i) {
    const int view = static_cast<int>(i);
    QUORUM_ASSIGN(const auto depth, read(view));
    for (Hole& hole : holes)
      if (looks_into(scene.views[i], depth, hole)) hole.seen_by.push_back(view);
  }
  for (Hole& hole : holes) hole.nearest = nearest_views(scene, hole);
  return {};
}

}  // namespace quorum
