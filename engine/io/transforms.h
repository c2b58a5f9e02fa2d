// Scenes of nerfstudio and instant-ngp: transforms.json beside the photographs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/output_folder.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads folder/transforms.json. Of each frame: file_path (below folder, or its end below images where that is given;
/// the extension may be left out), transform_matrix, camera to world with OpenGL's axes (x right, y up, z back), of
/// which a scale is taken off, mask_path, and the lens (lens_of_frame). Of the file: ply_file_path, whose points are
/// taken as seen by all views before which they lie. The center of the top-left pixel is (0.5, 0.5). Views in the order
/// of their names; frames without a photograph are left out. Notes tell what was left out, and which fields are not
/// used. The bounds are left empty. Fails (kInput) if the file is no JSON, a value is absent or of another kind, or as
/// lens_of_frame and ViewList do; the message names the frame.
Expected<Scene> read_transforms(const std::filesystem::path& folder, const std::filesystem::path& images);

/// Writes transforms.json of views whose pictures have these names in the folder's images. centers: of projection;
/// they stand in the file in place of the translations, which come back as translation_of_center. Numbers are the
/// shortest that read back as they are. members: text for the frame of each view (write_prior_maps), or empty. Fails
/// (kInput) if the file can't be written.
Expected<void> write_transforms(OutputFolder& output, const std::vector<View>& views,
                                const std::vector<std::string>& names, const std::vector<Eigen::Vector3d>& centers,
                                const std::vector<std::string>& members = {});

}  // namespace quorum
