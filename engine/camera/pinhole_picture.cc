#include "engine/camera/pinhole_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace quorum {
namespace {

constexpr int kSamples = 64;  // of each side of a picture

/// How far a picture reaches from the principal point, in rays: to the left, up, right, down.
using Reach = std::array<double, 4>;

/// The largest reach within the photograph's sides, as far as these show a ray, and within what is of use.
Reach widest_reach(const Lens& lens) {
  const double widest = std::tan(std::numbers::pi / 3.0);
  const Eigen::Vector2d last(lens.width - 1, lens.height - 1);
  Reach reach;
  for (std::size_t side = 0; side < 4; ++side) {
    const auto axis = static_cast<Eigen::Index>(side % 2);
    const double sign = side < 2 ? -1.0 : 1.0;
    reach[side] = std::min(widest, (last(axis) + 1.0) / lens.focal(axis));
    for (int sample = 0; sample <= kSamples; ++sample) {
      Eigen::Vector2d pixel;
      pixel(axis) = side < 2 ? 0.0 : last(axis);
      pixel(1 - axis) = last(1 - axis) * sample / kSamples;
      if (const auto ray = lens.unproject(pixel)) reach[side] = std::min(reach[side], sign * (*ray)(axis));
    }
  }
  return reach;
}

/// True if the photograph shows all rays of the picture's sides, each at a place of its own.
bool is_shown(const Lens& lens, const Reach& reach) {
  constexpr double kTolerance = 1e-6;
  const auto shows = [&lens](const Eigen::Vector2d& ray) {
    const Eigen::Vector2d pixel = lens.project(ray);
    if (!(pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < lens.width - 0.5 && pixel.y() < lens.height - 0.5))
      return false;
    const auto back = lens.unproject(pixel);
    return back && (*back - ray).norm() < kTolerance;
  };
  for (int sample = 0; sample <= kSamples; ++sample) {
    const double x = -reach[0] + (reach[0] + reach[2]) * sample / kSamples;
    const double y = -reach[1] + (reach[1] + reach[3]) * sample / kSamples;
    for (const Eigen::Vector2d& ray : {Eigen::Vector2d(x, -reach[1]), Eigen::Vector2d(x, reach[3]),
                                       Eigen::Vector2d(-reach[0], y), Eigen::Vector2d(reach[2], y)})
      if (!shows(ray)) return false;
  }
  return true;
}

}  // namespace

std::optional<PinholePicture> pinhole_picture(const Lens& lens) {
  constexpr double kShrink = 0.97;
  constexpr double kLeast = 0.1;
  Reach reach = widest_reach(lens);
  for (double scale = 1.0; !is_shown(lens, reach); scale *= kShrink) {
    if (scale < kLeast) return std::nullopt;
    for (double& side : reach) side *= kShrink;
  }
  PinholePicture picture;
  for (int axis = 0; axis < 2; ++axis) {
    const double before = reach[static_cast<std::size_t>(axis)] * lens.focal(axis);
    const double after = reach[static_cast<std::size_t>(axis) + 2] * lens.focal(axis);
    picture.intrinsics(axis, axis) = lens.focal(axis);
    picture.intrinsics(axis, 2) = before;
    // A hair more than the exact figure, so that a lens without distortion keeps its last pixel.
    const double pixels = std::floor(before + after + 1e-6) + 1.0;
    if (!(pixels >= 2.0)) return std::nullopt;
    (axis == 0 ? picture.width : picture.height) = static_cast<int>(pixels);
  }
  return picture;
}

}  // namespace quorum
