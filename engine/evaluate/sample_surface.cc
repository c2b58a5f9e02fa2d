#include "engine/evaluate/sample_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace quorum {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

Triangle corners(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.vertices[a].position.cast<double>(), mesh.vertices[b].position.cast<double>(),
          mesh.vertices[c].position.cast<double>()};
}

double area(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2; }

/// A number in [0, 1) that looks random. Source: Steele, Lea and Flood, "Fast splittable pseudorandom number
/// generators", 2014 (the mixer of SplitMix64).
double hashed_fraction(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t bits = seed * 0xd1342543de82ef95U + (index + 1) * 0x9e3779b97f4a7c15U;
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ bits >> 27) * 0x94d049bb133111ebU;
  bits ^= bits >> 31;
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// The place at (u, v) of the unit square, mapped to the triangle so that areas keep their ratio.
Eigen::Vector3d place_in(const Triangle& t, double u, double v) {
  const double root = std::sqrt(u);
  return t[0] * (1 - root) + (t[1] * (1 - v) + t[2] * v) * root;
}

}  // namespace

std::vector<Eigen::Vector3d> sample_surface(const Mesh& surface, std::uint64_t samples, std::uint64_t seed) {
  std::vector<Eigen::Vector3d> points;
  if (surface.triangles.empty()) {
    points.reserve(surface.vertices.size());
    for (const Vertex& vertex : surface.vertices) points.push_back(vertex.position.cast<double>());
    return points;
  }

  double total = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) total += area(corners(surface, t));
  const bool has_area = total > 0;
  const auto share_of = [&](const Triangle& triangle) { return has_area ? area(triangle) : 1.0; };
  if (!has_area) total = static_cast<double>(surface.triangles.size());

  // u comes from the place on the line of areas, v from multiples of the golden ratio: together a lattice that covers
  // a large triangle evenly. The jitter keeps it from falling into step with a regular mesh.
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double first_v = hashed_fraction(seed, samples);
  const double piece = total / static_cast<double>(samples);
  points.reserve(samples);
  std::size_t t = 0;
  Triangle triangle = corners(surface, 0);
  double begin = 0;
  double length = share_of(triangle);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const double position = (static_cast<double>(i) + hashed_fraction(seed, i)) * piece;
    while (position >= begin + length && t + 1 < surface.triangles.size()) {
      begin += length;
      triangle = corners(surface, ++t);
      length = share_of(triangle);
    }
    const double u = length > 0 ? std::clamp((position - begin) / length, 0.0, 1.0) : 0.5;
    const double v = first_v + static_cast<double>(i) * kGoldenRatio;
    points.push_back(place_in(triangle, u, v - std::floor(v)));
  }
  return points;
}

}  // namespace quorum
