// The photographs of a scene as files that fit its cameras.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Whether the photographs have to be written anew to fit the cameras: some view has a lens, or was halved.
bool needs_new_pictures(const Scene& scene);

/// Names of the pictures of all views, below a folder of ours. Those of the photographs, as far as all of them are
/// plain relative paths (is_plain_path) that differ also where case does not count; else, and where the photographs are
/// written anew, after the views.
std::vector<std::string> picture_names(const Scene& scene);

/// Writes the pictures of all views into folder under these names, which may have folders in them: copies of the
/// photographs, byte by byte, or PNG files where they are written anew. Holds one photograph at a time. Fails (kInput)
/// if a photograph can't be read, or a picture can't be written or would replace a file that is not ours (OutputFolder
/// of the folder's parent).
Expected<void> write_pictures(const std::filesystem::path& folder, const Scene& scene,
                              const std::vector<std::string>& names);

}  // namespace quorum
