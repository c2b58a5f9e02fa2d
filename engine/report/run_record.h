// What a run left in its workspace about itself, as JSON; damaged files are refused or say nothing.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/core/bounds.h"
#include "engine/core/error.h"
#include "engine/pipeline/workspace.h"
#include "engine/scene/scene.h"

namespace quorum {

/// run.json, an object. Fails (kInput) if there is none.
Expected<nlohmann::ordered_json> read_run(const Workspace& workspace);

/// What `quorum verify` has left of this run; empty if nothing.
nlohmann::ordered_json read_verified(const Workspace& workspace);

/// The views that a depth map was made with, from its record; none if it has none.
nlohmann::ordered_json neighbor_names(const Workspace& workspace, const std::string& view);

/// The box of the run, which its options may have given, in the frame of the scene; that of the scene if run.json has
/// none.
Bounds bounds_of(const nlohmann::ordered_json& run, const Scene& scene);

}  // namespace quorum
