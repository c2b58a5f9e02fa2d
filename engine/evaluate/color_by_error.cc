#include "engine/evaluate/color_by_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/option.h"
#include "engine/evaluate/distance.h"

namespace quorum {
namespace {

/// share: 0 blue, 1/3 green, 2/3 yellow, 1 red.
Rgba error_color(double share) {
  constexpr std::array<std::array<double, 3>, 4> kStops = {
      {{40, 80, 200}, {70, 170, 90}, {245, 215, 70}, {205, 40, 35}}};
  const double place = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double rest = place - static_cast<double>(first);
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint32_t>(kStops[first][c] + rest * (kStops[first + 1][c] - kStops[first][c]) + 0.5);
  };
  return make_rgb(channel(0), channel(1), channel(2));
}

}  // namespace

Expected<Mesh> color_by_error(Mesh mesh, const Mesh& truth, double full_error) {
  if (!(std::isfinite(full_error) && full_error > 0))
    return failure(ErrorKind::kUsage,
                   fmt::format("{} {}: give a distance above 0", option_name("full-error"), full_error));
  const auto distance = SurfaceDistance::build(truth);
  if (!distance) return std::unexpected(distance.error().within("truth"));
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) points.push_back(vertex.position.cast<double>());
  const std::vector<double> errors = distance->to(points);
  for (std::size_t v = 0; v < errors.size(); ++v) mesh.vertices[v].color = error_color(errors[v] / full_error);
  return mesh;
}

}  // namespace quorum
