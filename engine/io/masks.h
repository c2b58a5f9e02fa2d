// Which mask belongs to which photograph.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Sets mask_path of every view: MASKS/a.jpg.png, as COLMAP names it, or MASKS/a.png for the image a.jpg; below a
/// folder of images, in the same folder of masks. Fails (kInput) if a view has none.
/// The folders of an image's name may be missing below MASKS; two views never share a mask then.
Expected<void> find_masks(const std::filesystem::path& masks, std::vector<View>& views);

}  // namespace quorum
