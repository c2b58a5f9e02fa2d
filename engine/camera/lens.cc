#include "engine/camera/lens.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace quorum {

Eigen::Vector2d Lens::bend(const Eigen::Vector2d& ray) const {
  const auto& k = coefficients;
  const double r2 = ray.squaredNorm();
  if (model == Model::kFisheye) {
    const double r = std::sqrt(r2);
    if (r < 1e-12) return ray;
    const double angle = std::atan(r);
    const double a2 = angle * angle;
    return ray * (angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))) / r);
  }
  const double radial = (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  const double xy = ray.x() * ray.y();
  return {ray.x() * radial + 2.0 * k[2] * xy + k[3] * (r2 + 2.0 * ray.x() * ray.x()),
          ray.y() * radial + k[2] * (r2 + 2.0 * ray.y() * ray.y()) + 2.0 * k[3] * xy};
}

Eigen::Vector2d Lens::project(const Eigen::Vector2d& ray) const { return bend(ray).cwiseProduct(focal) + principal; }

std::optional<Eigen::Vector2d> Lens::unproject(const Eigen::Vector2d& pixel) const {
  constexpr int kSteps = 50;
  constexpr double kTolerance = 1e-9;
  const Eigen::Vector2d bent = (pixel - principal).cwiseQuotient(focal);
  Eigen::Vector2d ray = bent;
  if (model == Model::kFisheye) {
    const double angle = bent.norm();
    if (angle >= std::numbers::pi / 2) return std::nullopt;
    if (angle > 1e-12) ray *= std::tan(angle) / angle;
  }
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector2d error = bend(ray) - bent;
    const double nudge = 1e-6 * (1.0 + ray.norm());
    Eigen::Matrix2d slope;
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Vector2d side = Eigen::Vector2d::Zero();
      side(axis) = nudge;
      slope.col(axis) = (bend(ray + side) - bend(ray - side)) / (2.0 * nudge);
    }
    if (!slope.allFinite() || slope.determinant() <= 0.0) return std::nullopt;  // the picture folds over
    if (error.norm() < kTolerance) return ray;
    // A step is at most as long as the ray reaches, so that it can't jump over a fold.
    Eigen::Vector2d change = slope.inverse() * error;
    const double longest = 0.5 * (1.0 + ray.norm());
    if (change.norm() > longest) change *= longest / change.norm();
    ray -= change;
  }
  return std::nullopt;
}

bool Lens::is_pinhole() const {
  return model == Model::kRadial && std::ranges::all_of(coefficients, [](double k) { return k == 0.0; });
}

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
