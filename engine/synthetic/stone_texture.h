// Weathered limestone: solid noise in several octaves, from pits below a millimeter to stains of centimeters.
// After Perlin, An Image Synthesizer, SIGGRAPH 1985, with a lattice of hashed values instead of gradients.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace quorum {

/// Reflectance (red, green, blue), each within 0 to 1, of the stone at a point. The point is in meters; strength 0 is
/// plain plaster, 1 weathered limestone. The same point, strength and seed give the same color everywhere.
Eigen::Vector3d stone_reflectance(const Eigen::Vector3d& point, double strength, std::uint64_t seed);

}  // namespace quorum
