// Scenes of Meshroom and AliceVision (Griwodz et al. 2021): files .sfm.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads a file .sfm (JSON, versions 1.0 to 1.2): views whose pose and intrinsic are there, distortions radialk1,
/// radialk3, brown, fisheye4, fisheye1 or none, under their old names, too, and the structure, if the file has it.
/// Rotations are world to camera, listed column by column; centers are in the world; the center of the top-left pixel
/// is (0, 0). Versions before 1.2.1 count the principal point from the picture's corner, later ones from its center.
/// Photographs stand below images, or where the file says, or around it (photograph_folders). Fails (kInput), naming
/// the view, pose or intrinsic, if a value is absent or of another kind, a lens is another one, a view is of a rig, no
/// view has a pose, or as ViewList does.
Expected<Scene> read_meshroom(const std::filesystem::path& file, const std::filesystem::path& images);

}  // namespace quorum
