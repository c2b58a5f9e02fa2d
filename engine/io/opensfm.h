// Scenes of OpenSfM and OpenDroneMap: reconstruction.json and tracks.csv.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads a file reconstruction.json: of several reconstructions the one with the most shots, with lenses perspective,
/// simple_radial, radial, brown, fisheye, fisheye_opencv and fisheye62 (without k5, k6). Rotations are angle-axis and
/// translations world to camera; lengths in the picture count in its longer side, from its center. tracks.csv beside it
/// says who sees the points; without it those count that have a point before them. Photographs stand below images, or
/// around the file (photograph_folders). Fails (kInput), naming the shot or camera, if a value is absent or of another
/// kind, a camera is a panorama or another one, or as ViewList does.
Expected<Scene> read_opensfm(const std::filesystem::path& file, const std::filesystem::path& images);

}  // namespace quorum
