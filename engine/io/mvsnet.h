// Scenes in the layout of MVSNet (Yao, Luo, Li, Fang, Quan 2018): cams/00000000_cam.txt, images/00000000.jpg, pair.txt.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "engine/core/error.h"
#include "engine/io/output_folder.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads the scene in folder. A camera's file holds the word extrinsic and a 4 × 4 matrix, world to camera, the word
/// intrinsic and a 3 × 3 matrix, and "depth_min interval [count [depth_max]]", which gives the view's depth range (with
/// 192 depths where no count stands there). The center of the top-left pixel is (0.5, 0.5), as in MVSNet's own warp and
/// in what is converted from COLMAP. Images have the number of their camera as name and stand in the folder images, or
/// in the folder images where that is given; a camera without one is left out. pair.txt, here or in cams, gives each
/// view's neighbors in its order; numbers of other views are left out. Notes say so. The bounds are left empty. Fails
/// (kInput), naming file and line, if a file is absent or malformed, or as ViewList does.
Expected<Scene> read_mvsnet(const std::filesystem::path& folder, const std::filesystem::path& images);

/// What files of the view of a number are called: eight digits.
std::string mvsnet_name(std::size_t number);

/// Writes cams and pair.txt of a scene whose images stand in the folder's images under their numbers. The depth range
/// is the view's, with 192 depths, or that of the bounds; the neighbors are the first ten of select_views, with scores
/// that fall from ten. Numbers are the shortest that read back as they are. Fails (kInput) if the bounds lie behind a
/// view without a depth range, or a file can't be written.
Expected<void> write_mvsnet(OutputFolder& output, const Scene& scene);

}  // namespace quorum
