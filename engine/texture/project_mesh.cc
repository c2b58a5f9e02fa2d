#include "engine/texture/project_mesh.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace quorum {
namespace {

constexpr double kFarthest = 1 << 18;         // pixels from the frame's corner: products of edges fit 64 bits
constexpr double kNearestShare = 1.0 / 1024;  // of the largest depth: what is nearer is not in reach

/// Toward minus infinity.
std::int64_t floor_pixel(std::int64_t position) { return position >> 8; }
std::int64_t ceil_pixel(std::int64_t position) { return -floor_pixel(-position); }

}  // namespace

Projector::Projector(const Camera& camera) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      double sum = 0;
      for (int i = 0; i < 3; ++i)
        sum += camera.intrinsics(row, i) * (column < 3 ? camera.camera_from_world(i, column) : camera.translation(i));
      rows_[row][column] = sum;
    }
}

Projector::Place Projector::operator()(const Eigen::Vector3d& point) const {
  double sums[3];
  for (int row = 0; row < 3; ++row)
    sums[row] = rows_[row][0] * point.x() + rows_[row][1] * point.y() + rows_[row][2] * point.z() + rows_[row][3];
  return {sums[0] / sums[2], sums[1] / sums[2], sums[2]};
}

std::vector<Projector> view_projectors(const Scene& scene) {
  std::vector<Projector> projectors;
  for (const View& view : scene.views) projectors.emplace_back(view.camera);
  return projectors;
}

ProjectedVertex snap(const Projector::Place& place) {
  const auto on_grid = [](double pixels) { return static_cast<std::int32_t>(std::floor(pixels * kSubpixels + 0.5)); };
  const bool in_reach = place.depth > 0 && std::abs(place.x) < kFarthest && std::abs(place.y) < kFarthest;
  return in_reach ? ProjectedVertex{on_grid(place.x), on_grid(place.y), 1} : ProjectedVertex{};
}

ProjectedMesh project_mesh(const Mesh& mesh, const View& view) {
  const Projector project(view.camera);
  ProjectedMesh projected;
  projected.vertices.resize(mesh.vertices.size());
  std::vector<double> depths(mesh.vertices.size());
  tbb::parallel_for(std::size_t{0}, depths.size(), [&](std::size_t v) {
    const Projector::Place place = project(mesh.vertices[v].position.cast<double>());
    projected.vertices[v] = snap(place);
    depths[v] = projected.vertices[v].nearness > 0 ? place.depth : 0;
  });
  const double farthest = depths.empty() ? 0 : *std::ranges::max_element(depths);
  double nearest = farthest;
  for (const double depth : depths)
    if (depth >= farthest * kNearestShare) nearest = std::min(nearest, depth);
  tbb::parallel_for(std::size_t{0}, depths.size(), [&](std::size_t v) {
    const bool in_reach = depths[v] > 0 && depths[v] >= nearest;
    projected.vertices[v].nearness = in_reach ? static_cast<std::uint32_t>(nearest / depths[v] * 0x1p31) : 0;
  });
  projected.footprint = 1 / std::min(view.camera.intrinsics(0, 0), view.camera.intrinsics(1, 1));
  return projected;
}

TrianglePixels::TrianglePixels(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c)
    : x_{a.x, b.x, c.x}, y_{a.y, b.y, c.y} {
  signed_area_ = (x_[1] - x_[0]) * (y_[2] - y_[0]) - (x_[2] - x_[0]) * (y_[1] - y_[0]);
}

TrianglePixels::Box TrianglePixels::box(int width, int height, int grow) const {
  const auto within = [](std::int64_t value, int end) {
    return static_cast<int>(std::clamp<std::int64_t>(value, -1, end));
  };
  const auto [left, right] = std::ranges::minmax(x_);
  const auto [top, bottom] = std::ranges::minmax(y_);
  return {std::max(0, within(ceil_pixel(left) - grow, width)), std::max(0, within(ceil_pixel(top) - grow, height)),
          within(floor_pixel(right) + grow, width - 1), within(floor_pixel(bottom) + grow, height - 1)};
}

std::int64_t TrianglePixels::edge(int i, int x, int y) const {
  const int from = (i + 1) % 3;
  const int to = (i + 2) % 3;
  const std::int64_t area = (x_[to] - x_[from]) * (std::int64_t{y} * kSubpixels - y_[from]) -
                            (std::int64_t{x} * kSubpixels - x_[from]) * (y_[to] - y_[from]);
  return signed_area_ < 0 ? -area : area;
}

std::array<double, 3> TrianglePixels::shares(int x, int y) const {
  if (signed_area_ == 0) return {1 / 3.0, 1 / 3.0, 1 / 3.0};
  const auto whole = static_cast<double>(std::abs(signed_area_));
  std::array<double, 3> shares{};
  for (int i = 0; i < 3; ++i) shares[i] = static_cast<double>(edge(i, x, y)) / whole;
  return shares;
}

bool TrianglePixels::covers(int x, int y) const {
  return edge(0, x, y) >= 0 && edge(1, x, y) >= 0 && edge(2, x, y) >= 0;
}

}  // namespace quorum
