#include "engine/evaluate/distance.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numeric>

#include "engine/core/check.h"
#include "engine/evaluate/primitive_tree.h"

namespace quorum {

Expected<void> check_surface(const Mesh& surface) {
  if (surface.vertices.empty())
    return failure(ErrorKind::kInput, "the surface is empty; give a mesh or a cloud with at least one vertex");
  for (std::size_t i = 0; i < surface.vertices.size(); ++i)
    if (!surface.vertices[i].position.allFinite())
      return failure(ErrorKind::kInput, fmt::format("vertex {} of {} has a position that is not finite; remove it", i,
                                                    surface.vertices.size()));
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t corner : triangle) QUORUM_CHECK_LT(corner, surface.vertices.size());
  return {};
}

Expected<SurfaceDistance> SurfaceDistance::build(const Mesh& surface) {
  QUORUM_TRY(check_surface(surface));
  const std::size_t count = surface.triangles.empty() ? surface.vertices.size() : surface.triangles.size();
  if (count >= RTC_INVALID_GEOMETRY_ID)
    return failure(ErrorKind::kMemory, fmt::format("{} triangles or points; at most 2^32 - 2 can be searched, evaluate "
                                                   "parts of them",
                                                   count));
  std::vector<std::uint32_t> primitives(count);
  std::iota(primitives.begin(), primitives.end(), 0U);
  SurfaceDistance distance;
  while (!primitives.empty()) {
    std::shared_ptr<PrimitiveTree> tree = PrimitiveTree::take_cluster(surface, primitives);
    QUORUM_TRY(tree->build());
    distance.trees_.push_back(std::move(tree));
  }
  return distance;
}

double SurfaceDistance::operator()(const Eigen::Vector3d& point) const {
  PrimitiveTree::Search search{nullptr, point};
  for (const auto& tree : trees_) tree->look_for_closer(search);
  return std::sqrt(search.squared_distance);
}

std::vector<double> SurfaceDistance::to(std::span<const Eigen::Vector3d> points) const {
  std::vector<double> distances(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) distances[i] = (*this)(points[i]);
  });
  return distances;
}

}  // namespace quorum
