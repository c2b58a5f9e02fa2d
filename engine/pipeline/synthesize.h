// A synthetic scene as a folder that the other commands read.
#pragma once

#include <filesystem>

#include "engine/core/error.h"
#include "engine/pipeline/progress.h"
#include "engine/synthetic/temple.h"

namespace quorum {

/// Renders the temple into a Middlebury folder: photographs, temple_par.txt, README.txt with the bounds, and the exact
/// surface gt.ply. Makes the folder; one that holds such a temple gets the new one. Fails (kUsage) on options out of
/// range, (kInput) if a file can't be written, or would replace one that is not of a temple, and (kStopped) before the
/// next photograph if progress asks for it.
Expected<void> synthesize_temple(const std::filesystem::path& folder, const TempleOptions& options,
                                 const Progress& progress = Progress());

}  // namespace quorum
