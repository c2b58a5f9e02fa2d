// Names that a scene's views and files get from us. What the scene calls a photograph is a label: it may be absolute,
// climb out of its folder, or hold anything.
#pragma once

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Sets View::name of all views from their image_name: its path below the folder of images without extension, with "_"
/// in place of "/"; with the extension where two would be the same, and a number where two still are. Names are unique
/// also where case does not count, without separators, control characters and dots at the beginning, valid UTF-8, and
/// have 1 to 100 bytes. Of a name that is absolute or climbs (..) the file's name alone is taken where that is enough.
/// Fails (kInput) if two views have one image_name.
Expected<void> name_views(std::vector<View>& views);

/// True if an image's name can be used for a file below a folder of ours as it is: a relative path of ordinary names.
bool is_plain_path(const std::string& image_name);

/// The text in lower case as far as it is ASCII, to compare names where case does not count.
std::string folded(std::string text);

}  // namespace quorum
