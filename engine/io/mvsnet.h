// Scenes in the layout of MVSNet (Yao, Luo, Li, Fang, Quan 2018): cams/00000000_cam.txt, images/00000000.jpg, pair.txt.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads the scene in folder. A camera's file holds the word extrinsic and a 4 × 4 matrix, world to camera, the word
/// intrinsic and a 3 × 3 matrix, and "depth_min interval [count [depth_max]]", which gives the view's depth range (with
/// 192 depths where no count stands there). The center of the top-left pixel is (0.5, 0.5), as in MVSNet's own warp and
/// in what is converted from COLMAP. Images have the number of their camera as name and stand in the folder images, or
/// in the folder images where that is given. pair.txt, if it is there, gives each view's neighbors in its order. The
/// bounds are left empty. Fails (kInput), naming file and line, if a file is absent or malformed, a number in pair.txt
/// has no camera, or there are fewer than three views.
Expected<Scene> read_mvsnet(const std::filesystem::path& folder, const std::filesystem::path& images);

}  // namespace quorum
