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

/// Names of the pictures of all views: those of the photographs, or after the views where they are written anew.
std::vector<std::string> picture_names(const Scene& scene);

/// Writes the pictures of all views into folder under these names, which may have folders in them: copies of the
/// photographs, byte by byte, or PNG files where they are written anew. Holds one photograph at a time. Fails (kInput)
/// if a photograph can't be read or a picture can't be written.
Expected<void> write_pictures(const std::filesystem::path& folder, const Scene& scene,
                              const std::vector<std::string>& names);

}  // namespace quorum
