// What the page of the report shows, as one JSON text.
#pragma once

#include <string>

#include "engine/core/error.h"
#include "engine/pipeline/memory_budget.h"
#include "engine/pipeline/progress.h"
#include "engine/pipeline/workspace.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Reads run.json, the mesh, depth maps, certainties and photographs of a run, a view at a time, and gives:
///   mesh      positions, colors, confidence, views per vertex and triangles, base64 (packed_mesh.h); texture
///             (page_texture.h); faces and vertices of the whole mesh
///   views     name, camera, neighbors, valid share, photograph and certainty as data URLs
///   holes     center, normal, diameter, line, what sees them, the nearest photographs, and what would close them
///   histogram of the confidences of all vertices, and the value at its right end
///   verified  verified.json: devices on which `quorum verify` found the same bytes
///   run       run.json as it is; files: SHA-256 of mesh and photographs
/// Fails (kInput) if the workspace has no run.json or no mesh, or if a file of the scene or of the run can't be read;
/// (kStopped).
Expected<std::string> page_data(const Scene& scene, const Workspace& workspace, const MemoryBudget& budget,
                                Progress& progress);

}  // namespace quorum
