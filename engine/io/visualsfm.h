// Scenes of VisualSFM (Wu 2011): files .nvm.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads a file .nvm (version 3, quaternions): of several models the one with the most cameras, with its points and who
/// sees them. A camera: its focal length, a quaternion w x y z world to camera, its center, and the lens of VisualSFM
/// (Lens::Model::kInverseRadial) around the picture's center; "FixedK fx cx fy cy" in the first line holds for all.
/// Photographs stand below images, or around the file (photograph_folders). Fails (kInput), naming file and line, if it
/// is malformed or cut off, or as ViewList does.
Expected<Scene> read_visualsfm(const std::filesystem::path& file, const std::filesystem::path& images);

}  // namespace quorum
