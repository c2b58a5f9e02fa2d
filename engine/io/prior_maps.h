// What was measured of a view, as files beside a scene for programs that start from it.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "engine/core/grid.h"
#include "engine/io/output_folder.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Maps of a view's size; 0 where nothing was measured.
struct PriorMaps {
  Grid<float> depth;                     ///< along the optical axis, scene units
  Grid<Eigen::Vector3f> normal;          ///< unit length, camera axes: x right, y down, z ahead
  std::optional<Grid<float>> certainty;  ///< of the depth
};

/// Gives the maps of a view, or none if it has none. Fails (kInput) if they can't be read.
using PriorSource = std::function<Expected<std::optional<PriorMaps>>(const View& view)>;

/// Writes depths/NAME.npy, normals/NAME.npy and certainties/NAME.npy: NumPy files of version 1.0, float32 in C order,
/// the depths in thousandths of a scene unit, since nerfstudio multiplies depth files by 0.001. Returns the members of
/// the view's frame in transforms.json that name them, each behind a comma. Fails (kInput) as OutputFolder::write does.
Expected<std::string> write_prior_maps(OutputFolder& output, const std::string& name, const PriorMaps& maps);

}  // namespace quorum
