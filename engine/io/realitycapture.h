// Cameras of RealityCapture and RealityScan: the CSV file of Export > Registration > Internal/External camera
// parameters.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// True if a file begins as that export does.
bool is_realitycapture_file(const std::filesystem::path& file);

/// Reads the file, whose first line names the columns: #name, x, y, alt, heading, pitch, roll (degrees), f, and, where
/// they are not 0, px, py, k1 to k4. f, px and py are millimeters where the photograph's longer side is 36. A camera
/// without turn looks down with its top to the north. k1 to k4 are taken for Brown's model, since the file doesn't name
/// it; a note says so. Photographs stand below images, or around the file (photograph_folders). Fails (kInput), naming
/// the line, if a column is missing, a value is no number, t1 or t2 is not 0 (their order is not documented), or as
/// ViewList does.
Expected<Scene> read_realitycapture(const std::filesystem::path& file, const std::filesystem::path& images);

}  // namespace quorum
