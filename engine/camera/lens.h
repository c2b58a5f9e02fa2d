// A lens that bends its picture, in the models of OpenCV and COLMAP.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace quorum {

/// Maps a ray (x / z, y / z in the camera frame) to a pixel of the photograph as it was taken. Pixels as in camera.h:
/// the center of the top-left one is (0, 0).
struct Lens {
  enum class Model {
    kRadial,   ///< Brown 1971 with a rational radial term: k1 k2 p1 p2 k3 k4 k5 k6 (OpenCV's order), and k of r^8 above
    kFisheye,  ///< Kannala and Brandt 2006: the angle to the axis is bent by k1 k2 k3 k4
    kThinPrismFisheye,        ///< Weng et al. 1992 on the angle's picture: k1 k2 p1 p2 k3 k4 sx1 sy1 (COLMAP's order)
    kRadTanThinPrismFisheye,  ///< the like of Project Aria, prisms after radial terms: k0 to k5, p0 p1, s0 to s3
    kFov,                     ///< Devernay and Faugeras 2001: omega, radians
    kDivision,                ///< Fitzgibbon 2001: k; the ray is the bent one divided by 1 + k r^2
    kEucm,                    ///< Khomutenko, Garcia, Martinet 2016: alpha, beta
    kInverseRadial,           ///< of VisualSFM (Wu 2011): k; the ray is the bent one times 1 + k r^2
  };
  Model model = Model::kRadial;
  int width = 0;                                        ///< of the photograph, pixels
  int height = 0;                                       ///< of the photograph, pixels
  Eigen::Vector2d focal = Eigen::Vector2d::Ones();      ///< pixels along x and y
  Eigen::Vector2d principal = Eigen::Vector2d::Zero();  ///< pixels
  std::array<double, 12> coefficients = {};             ///< of the model, in its order

  /// Pixel at which the lens shows a ray.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector2d& ray) const;
  /// The ray that the lens shows at a pixel, by Newton's method from the inverse of the model's main part; nothing if
  /// no ray before the camera is shown there, or if the model folds over before it.
  [[nodiscard]] std::optional<Eigen::Vector2d> unproject(const Eigen::Vector2d& pixel) const;
  /// True if the picture is a pinhole's already.
  [[nodiscard]] bool is_pinhole() const;

 private:
  [[nodiscard]] Eigen::Vector2d bend(const Eigen::Vector2d& ray) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> first_guess(const Eigen::Vector2d& bent) const;
};

}  // namespace quorum
