#include "engine/synthetic/stone_texture.h"

#include <cmath>

#include "engine/synthetic/hash.h"

namespace quorum {

namespace {

struct Octave {
  double cell;    ///< distance of lattice points, meters
  double weight;  ///< share of this octave's values, which lie in -1 to 1
};

constexpr Octave kGrain[] = {{0.0007, 0.20}, {0.0013, 0.18}, {0.0031, 0.13}};
constexpr Octave kStains[] = {{0.0083, 0.15}, {0.0240, 0.18}};
constexpr Octave kErosion[] = {{0.0060, 0.8}, {0.0150, 0.5}};
constexpr Octave kWarmth[] = {{0.0045, 0.6}, {0.0150, 0.6}};

/// Uniform in -1 to 1 for each point of the integer lattice.
double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t salt) {
  const std::uint64_t key = static_cast<std::uint64_t>(x) * 0x8cb92ba72f3d8dd7ULL +
                            static_cast<std::uint64_t>(y) * 0xd1342543de82ef95ULL +
                            static_cast<std::uint64_t>(z) * 0xaef17502108ef2d9ULL;
  return static_cast<double>(mix(key ^ salt) >> 11) * 0x1p-52 - 1.0;
}

/// Lattice values joined smoothly, -1 to 1. point: in cells.
double value_noise(const Eigen::Vector3d& point, std::uint64_t salt) {
  const Eigen::Vector3d cell = point.array().floor();
  const Eigen::Vector3d f = point - cell;
  const Eigen::Vector3d s = f.array() * f.array() * (3.0 - 2.0 * f.array());
  const auto x = static_cast<std::int64_t>(cell.x());
  const auto y = static_cast<std::int64_t>(cell.y());
  const auto z = static_cast<std::int64_t>(cell.z());
  const auto edge = [&](std::int64_t edge_y, std::int64_t edge_z) {
    const double left = lattice_value(x, edge_y, edge_z, salt);
    return left + s.x() * (lattice_value(x + 1, edge_y, edge_z, salt) - left);
  };
  const auto face = [&](std::int64_t face_z) {
    const double top = edge(y, face_z);
    return top + s.y() * (edge(y + 1, face_z) - top);
  };
  const double front = face(z);
  return front + s.z() * (face(z + 1) - front);
}

template <int N>
double sum_octaves(const Octave (&octaves)[N], const Eigen::Vector3d& point, std::uint64_t seed) {
  // Turned out of the axes (the quaternion 1, 2, 3, 4), so that no flat face lies in a plane of the lattice, where the
  // noise would show its grid.
  static const Eigen::Matrix3d kLatticeFromWorld =
      (Eigen::Matrix3d() << -20, 4, 22, 20, -10, 20, 10, 28, 4).finished() / 30.0;
  const Eigen::Vector3d turned = kLatticeFromWorld * point;
  double sum = 0;
  for (const Octave& octave : octaves) sum += octave.weight * value_noise(turned / octave.cell, seed = mix(seed));
  return sum;
}

/// Maps all numbers to -1 to 1, with slope 1 at 0.
double squash(double x) { return x / std::sqrt(1.0 + x * x); }

}  // namespace

Eigen::Vector3d stone_reflectance(const Eigen::Vector3d& point, double strength, std::uint64_t seed) {
  constexpr double kMean = 0.55;
  constexpr double kReach = 0.75;  // brightness stays within 0.25 and 1.75 of the mean
  constexpr double kWarmReach = 0.12;
  const Eigen::Array3d plaster(1.00, 0.88, 0.68);
  const double erosion = 1.0 + 0.9 * squash(sum_octaves(kErosion, point, mix(seed + 1)));  // smooth and rough patches
  const double pattern =
      erosion * sum_octaves(kGrain, point, mix(seed + 2)) + sum_octaves(kStains, point, mix(seed + 3));
  const double brightness = squash(strength * pattern / kReach);
  const double warmth = kWarmReach * squash(strength * sum_octaves(kWarmth, point, mix(seed + 4)));
  return kMean * (1.0 + kReach * brightness) * plaster *
         Eigen::Array3d(1.0 + 0.3 * warmth, 1.0 - 0.2 * warmth, 1.0 - 1.5 * warmth);
}

}  // namespace quorum
