// The texture of a mesh, with a run's progress and budget of memory.
#pragma once

#include "engine/pipeline/memory_budget.h"
#include "engine/pipeline/progress.h"
#include "engine/texture/texture_mesh.h"

namespace quorum {

/// texture_mesh, with the photographs and masks of a scene. mask_below: as in ImageStore. Fails as texture_mesh does,
/// (kMemory) if the budget does not hold what it takes, and (kStopped).
Expected<Textured> texture_scene(const Mesh& mesh, const Scene& scene, const TextureOptions& options, double mask_below,
                                 const MemoryBudget& budget, Progress& progress);

/// "12345 triangles, 678 of them unseen; 90 patches of 12 photographs; page of 2048 x 1024".
std::string describe(const Textured& textured);

}  // namespace quorum
