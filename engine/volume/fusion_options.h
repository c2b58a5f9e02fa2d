// Options of the fusion stages.
#pragma once

#include "engine/core/error.h"

namespace quorum {

struct FusionOptions {
  double voxel_size = 0.0;       ///< edge of a voxel, scene units; 0 = automatic, the median footprint of a pixel
  double truncation = 0.0;       ///< where the signed distance is cut, scene units; 0 = automatic, 4 voxels
  double max_slope_deg = 70;     ///< steepest triangle of a range surface against the image plane, 10..89
  int feather = 4;               ///< pixels over which weights rise from a border of a range surface, 0..8
  bool weigh_confidence = true;  ///< a vertex weighs by its confidence
  bool weigh_slant = true;       ///< less at grazing angles
  bool weigh_border = true;      ///< less near borders of its range surface

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
};

}  // namespace quorum
