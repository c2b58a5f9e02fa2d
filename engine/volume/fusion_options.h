// Options of the fusion stages.
#pragma once

namespace quorum {

/// Along which direction the volume's signed distance is measured.
enum class SignedDistance {
  kNormal,  ///< along the surface's normal: the cosine between normal and line of sight times that of kRay
  kRay,     ///< along the line of sight, as Curless and Levoy 1996
};

struct FusionOptions {
  double voxel_size = 0.0;    ///< edge of a voxel, scene units; 0 = automatic, the median footprint of a pixel
  double truncation = 0.0;    ///< where the signed distance is cut, scene units; 0 = automatic, 3 voxels; 4 of kRay
  double max_slope_deg = 75;  ///< steepest triangle of a range surface against the image plane, 10..89
  /// Where a triangle is steeper than 40 degrees, how far one end of each edge may lie off the plane of the other,
  /// footprints of a pixel; 0 = anywhere.
  double plane_agreement = 0.95;
  int feather = 1;  ///< pixels over which weights rise from a border of a range surface, 0..8
  SignedDistance signed_distance = SignedDistance::kNormal;
  bool weigh_confidence = true;  ///< a vertex weighs by its confidence
  bool weigh_slant = true;       ///< less at grazing angles
  bool weigh_border = true;      ///< less near borders of its range surface
  bool fill_holes = false;       ///< close holes by space carving
};

}  // namespace quorum
