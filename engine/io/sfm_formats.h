// The files of programs for structure from motion that a folder may hold: which one, and how it is read.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/scene_folder.h"

namespace quorum {

struct SfmFormat {
  std::string_view name;  ///< that --format takes
  SceneFormat format = SceneFormat::kAutomatic;
  std::string_view files;  ///< for messages: "reconstruction.json (OpenSfM, ODM)"
  /// The files of this kind in a folder, sorted.
  std::vector<std::filesystem::path> (*find)(const std::filesystem::path& folder) = nullptr;
  /// Reads one, with its photographs below images, or where that is empty around it.
  Expected<Scene> (*read)(const std::filesystem::path& file, const std::filesystem::path& images) = nullptr;
};

/// All of them, in the order in which a folder is asked for them.
std::span<const SfmFormat> sfm_formats();

/// Reads the file of a format in a folder. Fails (kInput) if there is none, or several, and as its reader does.
Expected<Scene> read_sfm_format(const SfmFormat& format, const std::filesystem::path& folder,
                                const std::filesystem::path& images);

/// What helps with files in a folder that hold cameras and can't be read, as a clause for a message: "cameras.abc:
/// convert it with ..."; empty if there are none.
std::string unread_cameras(const std::filesystem::path& folder);

}  // namespace quorum
