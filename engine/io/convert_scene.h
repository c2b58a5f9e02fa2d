// A scene of any format that is read, written in another one.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/io/prior_maps.h"
#include "engine/scene/scene.h"

namespace quorum {

enum class ConvertedFormat {
  kColmap,      ///< images, sparse/*.bin
  kColmapText,  ///< images, sparse/*.txt
  kMvsnet,      ///< images, cams, pair.txt
  kTransforms,  ///< images, transforms.json
};

/// Writes a scene with its pictures (write_pictures) into folder, views in the order of their pictures' names, and
/// bounds.txt with its box, for read_roi. All formats read back as the same cameras to the last bit, so the same box
/// and neighbors give the same depth maps. The formats hold a pose as a quaternion, a matrix, or a matrix and a center,
/// of which none gives the others back exactly. Therefore each pose is rounded once to one that all of them hold: a
/// value of R moves by 2e-15 at most, t by about as much of its length, and a principal point whose fraction is finer
/// than that of its sum with 0.5 to the latter's. Points go to kColmap and kColmapText; depth ranges and neighbors to
/// kMvsnet, made by select_views and from the bounds where the scene has none; masks nowhere. priors: for kTransforms,
/// maps beside the pictures (write_prior_maps). Fails (kInput) as they do, if a
/// camera has skew, the bounds lie behind one, a photograph can't be read, or a file can't be written or would replace
/// one that is not ours (OutputFolder).
Expected<void> convert_scene(const std::filesystem::path& folder, const Scene& scene, ConvertedFormat format,
                             const PriorSource& priors = {});

}  // namespace quorum
