// Middlebury multi-view scenes (Seitz, Curless, Diebel, Scharstein, Szeliski 2006): a par file, images, a README with
// the bounding box.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/bounds.h"
#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads the scene in folder: the only *_par.txt in it (first line a count or a column header, or neither), with one
/// view per line, "name k11..k33 r11..r33 t1 t2 t3". K is scaled to K(2,2) = 1; R stays as given, since camera_defect()
/// refuses what is not a rotation within 1e-3. At least three views: a reference view and two neighbors.
/// bounds: the box, or nothing for the two lines "(x y z)" that follow the words "bounding box" in README.txt; without
/// that file they are found (find_extent).
/// images: the folder of the photographs, or empty if they stand beside the cameras.
/// masks: a folder with a mask for each image (a.png.png or a.png for a.png), or empty for none.
/// Each view has the size of its image, whose pixels are decoded only when a stage needs them (ImageStore); absent ones
/// are left out, and a note says so.
/// Fails (kInput) if a file is missing or malformed, or if the bounds are empty or no view sees them: the message names
/// file, line and remedy.
Expected<Scene> read_middlebury(const std::filesystem::path& folder, const std::optional<Bounds>& bounds,
                                const std::filesystem::path& masks, const std::filesystem::path& images = {});

/// Writes NAME_par.txt and README.txt of a scene whose images stand in folder already; the numbers read back as the
/// same doubles. Fails (kInput) if a file can't be written or the file name of an image has a space in it.
Expected<void> write_middlebury(const std::filesystem::path& folder, const std::string& name, const Scene& scene);

}  // namespace quorum
