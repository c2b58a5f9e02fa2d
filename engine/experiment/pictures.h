// The pictures that a run leaves of its scene's figure view.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/experiment/experiment.h"
#include "engine/experiment/scenes.h"
#include "engine/pipeline/workspace.h"

namespace quorum {

/// Writes PICTURE.png into folder for each Picture that the run has: the depth map as a lit surface, correlation and
/// confidence in gray (the paper, figure 2), the mesh lit, in color, by confidence and, where the truth is known, by
/// error (red: 1 mm and more), and the photograph; all cut to the object and set upright. A view without depth map has
/// none of the first three. Fails as reading, drawing and writing do.
Expected<void> write_pictures(const OpenScene& scene, const RunOptions& options, const Workspace& workspace,
                              const Mesh& mesh, const std::filesystem::path& folder);

}  // namespace quorum
