// The pinhole camera that replaces a lens.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/camera/lens.h"

namespace quorum {

/// A picture without distortion.
struct PinholePicture {
  Eigen::Matrix3d intrinsics = Eigen::Matrix3d::Identity();  ///< K, pixels
  int width = 0;                                             ///< pixels
  int height = 0;                                            ///< pixels
};

/// The pinhole picture that a lens's photograph is resampled to. The focal lengths stay, so the center keeps its
/// resolution; the picture is the largest one around the principal point with every side within the photograph, at most
/// 60 degrees from the axis and a width or height of the photograph away on each side; smaller where the lens's model
/// folds over within it. So it has no pixels without content, and what lies outside of it is lost. Nothing if the lens
/// shows no such picture (its coefficients are absurd).
std::optional<PinholePicture> pinhole_picture(const Lens& lens);

}  // namespace quorum
