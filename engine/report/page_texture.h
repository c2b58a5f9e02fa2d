// The mesh of a page with the photographs on it.
#pragma once

#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/mesh/textured_mesh.h"
#include "engine/pipeline/memory_budget.h"
#include "engine/pipeline/progress.h"
#include "engine/scene/scene.h"

namespace quorum {

/// The mesh, in the frame of the scene, textured from photographs of at most 1000 pixels a side, on pages that have
/// four million pixels together. Without pages, and with a note, if no photograph shows it or the budget does not hold
/// what texturing takes. Fails (kStopped).
Expected<TexturedMesh> texture_for_page(const Mesh& mesh, const Scene& scene, const MemoryBudget& budget,
                                        Progress& progress);

/// coordinates (uint16 x 2 a vertex, of 65535, base64), pages (addresses of pictures) and first_triangles (one more
/// than pages, then the number of all); null without pages. Fails (kInput) if a page can't be encoded.
Expected<nlohmann::ordered_json> texture_json(const TexturedMesh& mesh);

}  // namespace quorum
