#include "engine/synthetic/tessellate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace quorum {

namespace {

using Eigen::Vector3d;

constexpr double kSagitta = 1e-5;       ///< largest distance between a round face and its triangles, meters
constexpr double kRoom = 1.0 - 1e-3;    ///< keeps edges below their limit after rounding to float
constexpr double kShortestStep = 1e-6;  ///< cuts closer than this are one, meters

int steps_for(double length, double step) { return std::max(1, static_cast<int>(std::ceil(length / step))); }

std::uint32_t add_vertex(Mesh& mesh, const Vector3d& position, const Vector3d& normal) {
  Vertex vertex;
  vertex.position = position.cast<float>();
  vertex.normal = normal.cast<float>();
  mesh.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Adds a grid of (columns + 1) × (rows + 1) vertices, vertex(column, row) each, and its triangles. Counterclockwise
/// where columns go right and rows go up.
template <typename AddVertex>
void add_grid(Mesh& mesh, int columns, int rows, const AddVertex& vertex) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) vertex(column, row);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column) {
      const std::uint32_t corner = first + row * stride + column;
      mesh.triangles.push_back({corner, corner + 1, corner + stride + 1});
      mesh.triangles.push_back({corner, corner + stride + 1, corner + stride});
    }
  }
}

/// Shares of 0 to 1 that divide the way from low to high into steps of at most `step`, with the cuts among them.
std::vector<double> divide(double low, double high, double step, const std::vector<double>& cuts) {
  std::vector<double> stops = {low, high};
  for (const double cut : cuts)
    if (cut > low + kShortestStep && cut < high - kShortestStep) stops.push_back(cut);
  std::ranges::sort(stops);
  std::vector<double> shares = {0.0};
  double from = low;
  for (const double to : stops) {
    if (to - from < kShortestStep) continue;
    const int count = steps_for(to - from, step);
    for (int i = 1; i <= count; ++i) shares.push_back((from + (to - from) * i / count - low) / (high - low));
    from = to;
  }
  return shares;
}

/// The rectangle from origin along two edges; seen from outside, `along` goes right and `up` goes up.
void add_rectangle(Mesh& mesh, const Vector3d& origin, const Vector3d& along, const Vector3d& up,
                   const std::vector<double>& along_shares, const std::vector<double>& up_shares) {
  const Vector3d normal = along.cross(up).normalized();
  add_grid(mesh, static_cast<int>(along_shares.size()) - 1, static_cast<int>(up_shares.size()) - 1,
           [&](int column, int row) {
             add_vertex(mesh,
                        origin + along * along_shares[static_cast<std::size_t>(column)] +
                            up * up_shares[static_cast<std::size_t>(row)],
                        normal);
           });
}

/// A face of a box across an axis, at the low or the high end.
void add_box_face(Mesh& mesh, const Bounds& bounds, int axis, bool high, double step, const Cuts& cuts) {
  const int next = (axis + 1) % 3;
  const int last = (axis + 2) % 3;
  const int along = high ? next : last;
  const int up = high ? last : next;
  Vector3d origin = bounds.low;
  if (high) origin[axis] = bounds.high[axis];
  const Vector3d size = bounds.size();
  const auto shares = [&](int of) {
    return divide(bounds.low[of], bounds.high[of], step, cuts[static_cast<std::size_t>(of)]);
  };
  add_rectangle(mesh, origin, Vector3d::Unit(along) * size[along], Vector3d::Unit(up) * size[up], shares(along),
                shares(up));
}

/// A triangle divided into smaller ones of its own form. Counterclockwise from outside.
void add_triangle(Mesh& mesh, const Vector3d& a, const Vector3d& b, const Vector3d& c, double max_edge) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  const int count = steps_for(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}), max_edge);
  std::uint32_t below = 0;
  for (int row = 0; row <= count; ++row) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int column = 0; column <= count - row; ++column)
      add_vertex(mesh, a + (b - a) * column / count + (c - a) * row / count, normal);
    for (std::uint32_t column = 0; row > 0 && column <= static_cast<std::uint32_t>(count - row); ++column) {
      mesh.triangles.push_back({below + column, below + column + 1, first + column});
      if (column > 0) mesh.triangles.push_back({below + column, first + column, first + column - 1});
    }
    below = first;
  }
}

/// A disk of a drum, as rings around its center.
void add_disk(Mesh& mesh, const Vector3d& center, double radius, bool faces_up, int turns, double step) {
  const Vector3d normal = Vector3d::UnitY() * (faces_up ? 1.0 : -1.0);
  const int rings = steps_for(radius, step);
  const double clockwise = faces_up ? 2.0 * std::numbers::pi : -2.0 * std::numbers::pi;  // as seen from outside
  const std::uint32_t middle = add_vertex(mesh, center, normal);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  add_grid(mesh, turns, rings - 1, [&](int turn, int ring) {
    const double angle = clockwise * turn / turns;
    const double r = radius * (ring + 1) / rings;
    add_vertex(mesh, center + Vector3d(r * std::cos(angle), 0, r * std::sin(angle)), normal);
  });
  for (std::uint32_t turn = 0; turn < static_cast<std::uint32_t>(turns); ++turn)
    mesh.triangles.push_back({middle, first + turn + 1, first + turn});
}

void add_faces(Mesh& mesh, const Box& box, double max_edge, const Cuts& cuts) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true})
      add_box_face(mesh, box.bounds, axis, high, max_edge / std::numbers::sqrt2, cuts);
}

void add_faces(Mesh& mesh, const Drum& drum, double max_edge, const Cuts&) {
  const double step = max_edge / std::numbers::sqrt2;
  const double radius = std::max(drum.foot_radius, drum.head_radius);
  const double turn_by_sagitta = 2.0 * std::acos(1.0 - kSagitta / radius);
  const int turns =
      std::max(steps_for(2.0 * std::numbers::pi * radius, step), steps_for(2.0 * std::numbers::pi, turn_by_sagitta));
  const double slope = drum.slope();
  const int rows = steps_for(drum.height * std::sqrt(1.0 + slope * slope), step);
  add_grid(mesh, turns, rows, [&](int column, int row) {
    const double angle = -2.0 * std::numbers::pi * column / turns;  // right, as seen from outside
    const double height = drum.height * row / rows;
    const double r = drum.foot_radius + slope * height;
    add_vertex(mesh, drum.foot + Vector3d(r * std::cos(angle), height, r * std::sin(angle)),
               Vector3d(std::cos(angle), -slope, std::sin(angle)).normalized());
  });
  add_disk(mesh, drum.foot, drum.foot_radius, false, turns, step);
  add_disk(mesh, drum.foot + Vector3d(0, drum.height, 0), drum.head_radius, true, turns, step);
}

void add_faces(Mesh& mesh, const Gable& gable, double max_edge, const Cuts& cuts) {
  const double step = max_edge / std::numbers::sqrt2;
  const Bounds& bounds = gable.bounds;
  add_box_face(mesh, bounds, 1, false, step, cuts);
  const Vector3d depth(0, 0, bounds.size().z());
  const Vector3d left = bounds.low;
  const Vector3d right(bounds.high.x(), bounds.low.y(), bounds.low.z());
  const Vector3d ridge(bounds.center().x(), bounds.high.y(), bounds.low.z());
  const std::vector<double> along = divide(bounds.low.z(), bounds.high.z(), step, {});
  const std::vector<double> up = divide(0, (ridge - left).norm(), step, {});
  add_rectangle(mesh, left, depth, ridge - left, along, up);
  add_rectangle(mesh, right + depth, -depth, ridge - right, along, up);
  add_triangle(mesh, left + depth, right + depth, ridge + depth, max_edge);
  add_triangle(mesh, right, left, ridge, max_edge);
}

}  // namespace

Mesh tessellate(const Solid& solid, double max_edge, const Cuts& cuts) {
  Mesh mesh;
  std::visit([&](const auto& shape) { add_faces(mesh, shape, max_edge * kRoom, cuts); }, solid);
  return mesh;
}

}  // namespace quorum
