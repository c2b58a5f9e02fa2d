// Scenes of OpenMVG (Moulon, Monasse, Perrot, Marlet 2016): sfm_data.json.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads a file sfm_data.json with its cameras and structure: views whose pose and intrinsic are there, the lenses
/// pinhole, pinhole_radial_k1, pinhole_radial_k3, pinhole_brown_t2 and fisheye, and points with their observations.
/// Rotations are world to camera, centers in the world; the center of the top-left pixel is (0, 0). Photographs stand
/// below images, or where that is empty in the file's root_path, or around the file (photograph_folders). Fails
/// (kInput), naming the view or intrinsic, if a value is absent or of another kind, a lens is another one, no view has
/// a pose, or as ViewList does.
Expected<Scene> read_openmvg(const std::filesystem::path& file, const std::filesystem::path& images);

}  // namespace quorum
