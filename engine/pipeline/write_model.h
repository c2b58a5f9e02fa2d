// The mesh of a run for viewers: fewer triangles, the photographs on them.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// Writes model.glb into the workspace, as RunOptions::triangles and RunOptions::texture say. mesh: with triangles, in
/// the scene's frame. Fails as texture_scene does, (kInput) if it can't be written.
Expected<void> write_model(Run& run, const Mesh& mesh);

}  // namespace quorum
