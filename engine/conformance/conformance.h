// What every device must give: small scenes, options, and the SHA-256 of the results of each stage.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/pipeline/run.h"
#include "engine/synthetic/temple.h"

namespace quorum {

/// What is hashed, in the order in which one follows from the other.
constexpr std::array<std::string_view, 4> kConformanceStages = {"photographs", "cameras", "depth maps", "mesh"};

/// SHA-256 for each of kConformanceStages: pixels as red, green, blue and 255 in rows; matrices and bounds as doubles;
/// names and bytes of all depth/*.pfm in order of their names; bytes of mesh.ply.
using ConformanceHashes = std::array<std::string, kConformanceStages.size()>;

struct ConformanceCase {
  std::string name;
  TempleOptions temple;
  std::string options;  ///< of the run, as typed
  ConformanceHashes expected;
  bool quick = true;  ///< done within seconds, even on software Vulkan
};

const std::vector<ConformanceCase>& conformance_cases();

/// Makes the scene and reconstructs it below folder. Fails as these do.
Expected<ConformanceHashes> run_conformance(const ConformanceCase& conformance, Backend& backend,
                                            const std::filesystem::path& folder, Progress& progress);

/// The first stage in which found is not what is expected; empty if all are equal.
std::string_view first_difference(const ConformanceCase& conformance, const ConformanceHashes& found);

/// The page docs/conformance.md from "## Cases" on.
std::string conformance_markdown();

}  // namespace quorum
