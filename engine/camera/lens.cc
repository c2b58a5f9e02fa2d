#include "engine/camera/lens.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace quorum {

namespace {

using Coefficients = std::array<double, 12>;

/// The ray with its angle to the axis, radians, as its length.
Eigen::Vector2d by_angle(const Eigen::Vector2d& ray) {
  const double r = ray.norm();
  return r < 1e-12 ? ray : Eigen::Vector2d(ray * (std::atan(r) / r));
}

/// What decentered elements add (p1, p2 in OpenCV's order).
Eigen::Vector2d tangential(const Eigen::Vector2d& at, double p1, double p2) {
  const double r2 = at.squaredNorm();
  const double xy = at.x() * at.y();
  return {2.0 * p1 * xy + p2 * (r2 + 2.0 * at.x() * at.x()), p1 * (r2 + 2.0 * at.y() * at.y()) + 2.0 * p2 * xy};
}

Eigen::Vector2d bend_radial(const Eigen::Vector2d& ray, const Coefficients& k) {
  const double r2 = ray.squaredNorm();
  const double radial =
      (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * (k[4] + r2 * k[8])))) / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  const double xy = ray.x() * ray.y();
  return {ray.x() * radial + 2.0 * k[2] * xy + k[3] * (r2 + 2.0 * ray.x() * ray.x()),
          ray.y() * radial + k[2] * (r2 + 2.0 * ray.y() * ray.y()) + 2.0 * k[3] * xy};
}

Eigen::Vector2d bend_thin_prism(const Eigen::Vector2d& ray, const Coefficients& k) {
  const Eigen::Vector2d at = by_angle(ray);
  const double r2 = at.squaredNorm();
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * (k[4] + r2 * k[5])));
  return at * radial + tangential(at, k[2], k[3]) + r2 * Eigen::Vector2d(k[6], k[7]);
}

Eigen::Vector2d bend_rad_tan_thin_prism(const Eigen::Vector2d& ray, const Coefficients& k) {
  Eigen::Vector2d at = by_angle(ray);
  const double angle2 = at.squaredNorm();
  double radial = 0.0;
  for (std::size_t i = 6; i-- > 0;) radial = angle2 * (k[i] + radial);
  at *= 1.0 + radial;
  const double r2 = at.squaredNorm();
  return at + tangential(at, k[7], k[6]) + r2 * Eigen::Vector2d(k[8] + r2 * k[9], k[10] + r2 * k[11]);
}

constexpr double kLeastOmega = 1e-6;  // below, the field of view bends nothing

/// The factor of a ray of length r.
double field_of_view_factor(double r, double omega) {
  if (std::abs(omega) < kLeastOmega) return 1.0;
  const double slope = 2.0 * std::tan(0.5 * omega);
  return r < 1e-9 ? slope / omega : std::atan(r * slope) / (r * omega);
}

/// The bent length of a ray of length r whose bent one times 1 + k r^2 it is: the root of a cubic. Not a number beyond
/// the fold of a k below 0.
double inverse_radial_length(double r, double k) {
  if (k == 0.0) return r;
  const double a = 2.0 / std::sqrt(3.0 * std::abs(k));
  return k > 0.0 ? a * std::sinh(std::asinh(3.0 * r / a) / 3.0) : a * std::sin(std::asin(3.0 * r / a) / 3.0);
}

}  // namespace

/// Not finite where the model shows nothing.
Eigen::Vector2d Lens::bend(const Eigen::Vector2d& ray) const {
  const auto& k = coefficients;
  const double r2 = ray.squaredNorm();
  switch (model) {
    case Model::kRadial:
      return bend_radial(ray, k);
    case Model::kFisheye: {
      const double r = std::sqrt(r2);
      if (r < 1e-12) return ray;
      const double angle = std::atan(r);
      const double a2 = angle * angle;
      return ray * (angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3])))) / r);
    }
    case Model::kThinPrismFisheye:
      return bend_thin_prism(ray, k);
    case Model::kRadTanThinPrismFisheye:
      return bend_rad_tan_thin_prism(ray, k);
    case Model::kFov:
      return ray * field_of_view_factor(std::sqrt(r2), k[0]);
    case Model::kDivision:
      return ray * (2.0 / (1.0 + std::sqrt(1.0 - 4.0 * k[0] * r2)));
    case Model::kEucm: {
      const double below = k[0] * std::sqrt(k[1] * r2 + 1.0) + 1.0 - k[0];
      return ray / (below > 0.0 ? below : std::numeric_limits<double>::quiet_NaN());
    }
    case Model::kInverseRadial: {
      const double r = std::sqrt(r2);
      return r < 1e-12 ? ray : Eigen::Vector2d(ray * (inverse_radial_length(r, k[0]) / r));
    }
  }
  return ray;
}

/// The ray whose bent one this is by the main part of the model; nothing if it does not lie before the camera.
std::optional<Eigen::Vector2d> Lens::first_guess(const Eigen::Vector2d& bent) const {
  constexpr double kWidest = 1.5;  // radians; the search goes on to a quarter of a turn
  const auto& k = coefficients;
  const double r = bent.norm();
  double factor = 1.0;
  switch (model) {
    case Model::kRadial:
      break;
    case Model::kFisheye:
    case Model::kThinPrismFisheye:
    case Model::kRadTanThinPrismFisheye:
      if (r > 1e-12) factor = std::tan(std::min(r, kWidest)) / r;
      break;
    case Model::kFov: {
      const double angle = r * std::abs(k[0]);
      if (angle >= 0.5 * std::numbers::pi) return std::nullopt;
      if (std::abs(k[0]) >= kLeastOmega && r > 1e-9)
        factor = std::tan(angle) / (2.0 * r * std::tan(0.5 * std::abs(k[0])));
      break;
    }
    case Model::kDivision:
      factor = 1.0 / (1.0 + k[0] * r * r);
      break;
    case Model::kEucm: {
      const double b = k[1] * r * r;
      const double root = 1.0 - (2.0 * k[0] - 1.0) * b;
      if (root < 0.0) return std::nullopt;
      factor = (k[0] * std::sqrt(root) + 1.0 - k[0]) / (1.0 - k[0] * k[0] * b);
      break;
    }
    case Model::kInverseRadial:
      if (1.0 + 3.0 * k[0] * r * r <= 0.0) return std::nullopt;  // beyond the fold
      factor = 1.0 + k[0] * r * r;
      break;
  }
  if (!(factor > 0.0)) return std::nullopt;
  return bent * factor;
}

Eigen::Vector2d Lens::project(const Eigen::Vector2d& ray) const { return bend(ray).cwiseProduct(focal) + principal; }

std::optional<Eigen::Vector2d> Lens::unproject(const Eigen::Vector2d& pixel) const {
  constexpr int kSteps = 50;
  constexpr double kTolerance = 1e-9;
  const Eigen::Vector2d bent = (pixel - principal).cwiseQuotient(focal);
  const auto guess = first_guess(bent);
  if (!guess) return std::nullopt;
  Eigen::Vector2d ray = *guess;
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
  switch (model) {
    case Model::kRadial:
      return std::ranges::all_of(coefficients, [](double k) { return k == 0.0; });
    case Model::kFov:
      return std::abs(coefficients[0]) < kLeastOmega;
    case Model::kDivision:
    case Model::kEucm:
    case Model::kInverseRadial:
      return coefficients[0] == 0.0;
    default:
      return false;
  }
}

}  // namespace quorum
