#include "engine/volume/fusion_options.h"

#include <fmt/format.h>

namespace quorum {

Expected<void> FusionOptions::check() const {
  const auto wrong = [](std::string text) { return failure(ErrorKind::kUsage, std::move(text)); };
  if (!(voxel_size >= 0.0 && voxel_size < 1e12))
    return wrong(fmt::format("--voxel-size {}: give a positive length, or auto", voxel_size));
  if (!(truncation >= 0.0 && truncation < 1e12))
    return wrong(fmt::format("--truncation {}: give a positive length, or auto", truncation));
  if (truncation > 0.0 && voxel_size > 0.0 && (truncation < 1.5 * voxel_size || truncation > 32 * voxel_size))
    return wrong(fmt::format("--truncation {}: give 1.5 to 32 times the voxel size {}", truncation, voxel_size));
  if (!(max_slope_deg >= 10 && max_slope_deg <= 89))
    return wrong(fmt::format("--max-slope {}: give 10 to 89 degrees", max_slope_deg));
  if (feather < 0 || feather > 8) return wrong(fmt::format("--feather {}: give 0 to 8 pixels", feather));
  return {};
}

}  // namespace quorum
