// Scenes of nerfstudio and instant-ngp: transforms.json beside the photographs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads folder/transforms.json. Of each frame: file_path (below folder, or below images where that is given; .png may
/// be left out), and transform_matrix, camera to world with OpenGL's axes (x right, y up, z back). Of a frame or of the
/// whole file: fl_x, fl_y (fl_x if absent) or camera_angle_x; cx, cy (the center if absent); w, h (the photograph's if
/// absent); k1 k2 k3 k4 p1 p2; camera_model (OPENCV_FISHEYE takes k1 to k4 as angles; others as OPENCV). The center of
/// the top-left pixel is (0.5, 0.5). Views in the order of their names. The bounds are left empty. Fails (kInput) if
/// the file is no JSON, a value is absent or of another kind, or as ViewList does; the message names the frame.
Expected<Scene> read_transforms(const std::filesystem::path& folder, const std::filesystem::path& images);

/// Writes folder/transforms.json of views whose pictures have these names in folder/images. centers: of projection;
/// they stand in the file in place of the translations, which come back as translation_of_center. Numbers are the
/// shortest that read back as they are. Fails (kInput) if the file can't be written.
Expected<void> write_transforms(const std::filesystem::path& folder, const std::vector<View>& views,
                                const std::vector<std::string>& names, const std::vector<Eigen::Vector3d>& centers);

}  // namespace quorum
