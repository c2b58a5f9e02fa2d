// What a frame of transforms.json says of its lens.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>

#include "engine/camera/lens.h"
#include "engine/core/error.h"
#include "engine/io/image_size.h"

namespace quorum {

/// The lens of a frame, whose fields stand in it or else in the file: camera_model, is_fisheye, w, h, fl_x, fl_y,
/// camera_angle_x, camera_angle_y, cx, cy, k1 to k6, p1, p2. size: of the photograph, where w and h are absent.
/// nerfstudio's k4 is the factor of r^8; with k5 or k6, or as FULL_OPENCV, k4 to k6 stand below the fraction line. A
/// fisheye with p1 or p2 is THIN_PRISM_FISHEYE. Fails (kInput), naming the field, if one is of another kind, the model
/// is not known or no perspective one, there is no focal length, or a field changes the geometry and is not understood.
Expected<Lens> lens_of_frame(const nlohmann::json& frame, const nlohmann::json& file, ImageSize size);

/// Where a field stands: transform_matrix is one of a frame, ply_file_path one of the file, fl_x of either.
enum class FieldPlace { kFrame, kFile };

/// The names of fields of an object in this place that are neither used nor known to mean nothing here.
void add_unused_fields(const nlohmann::json& object, FieldPlace place, std::set<std::string>& names);

}  // namespace quorum
