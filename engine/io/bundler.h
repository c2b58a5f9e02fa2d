// Scenes of Bundler (Snavely, Seitz, Szeliski 2006): bundle.out and list.txt.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The file with the cameras in a folder: bundle.out or bundle/bundle.out. Empty if there is none.
std::filesystem::path find_bundle(const std::filesystem::path& folder);

/// Reads the bundle (version 0.3) and list.txt, which names a photograph per camera, below folder, or below images
/// where that is given: a line is a path, spaces included, and may end with the columns "0 650.5". Absent ones are left
/// out. The camera looks along -z, y up; the principal point is the center of the photograph; cameras with focal length
/// 0 were not found and are left out. The points come along with the views that see them. The bounds are left empty.
/// Fails (kInput), naming file and line, if a file is absent, malformed or cut off, a point refers to a camera that is
/// not there, or as ViewList does.
Expected<Scene> read_bundler(const std::filesystem::path& folder, const std::filesystem::path& images);

}  // namespace quorum
