#include "engine/conformance/conformance.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "engine/core/check.h"
#include "engine/io/file.h"
#include "engine/io/image_store.h"
#include "engine/io/sha256.h"
#include "engine/pipeline/reconstruct.h"
#include "engine/pipeline/stage_versions.h"
#include "engine/pipeline/synthesize.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// The options of a case, which are right.
RunOptions options_of(const ConformanceCase& conformance) {
  RunOptions options;
  options.saved_maps = SavedMaps::kAll;  // their bytes are compared
  std::istringstream words(conformance.options);
  std::string word;
  words >> word;
  while (!word.empty()) {
    const auto option = std::ranges::find(run_option_table(), word.substr(2), &RunOption::given_name);
    QUORUM_CHECK_EQ(option != run_option_table().end(), true);
    std::vector<std::string> values;
    for (word.clear(); words >> word && !word.starts_with("--"); word.clear()) values.push_back(word);
    QUORUM_CHECK_EQ(option->parse(options, values).has_value(), true);
  }
  return options;
}

Expected<std::string> hash_photographs(const Scene& scene) {
  ImageStore images(scene, 0);
  Sha256 hash;
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    QUORUM_ASSIGN(const auto image, images.image(view));
    hash.add_values(image->values.data(), image->values.size());
  }
  return hash.hex();
}

std::string hash_cameras(const Scene& scene) {
  Sha256 hash;
  for (const View& view : scene.views) {
    hash.add_values(view.camera.intrinsics.data(), 9);
    hash.add_values(view.camera.camera_from_world.data(), 9);
    hash.add_values(view.camera.translation.data(), 3);
  }
  hash.add_values(scene.bounds.low.data(), 3);
  hash.add_values(scene.bounds.high.data(), 3);
  return hash.hex();
}

Expected<std::string> hash_depth_maps(const fs::path& folder) {
  std::vector<fs::path> maps;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".pfm") maps.push_back(entry.path());
  std::ranges::sort(maps);
  Sha256 hash;
  for (const fs::path& map : maps) {
    QUORUM_ASSIGN(const std::string bytes, read_file(map));
    hash.add(map.filename().string());
    hash.add(bytes);
  }
  return hash.hex();
}

std::string scene_command(const TempleOptions& temple) {
  const TempleOptions usual;
  std::string command = fmt::format("--views {} --width {}", temple.views, temple.width);
  if (temple.path != usual.path) command += " --cameras hemisphere";
  if (temple.texture != usual.texture) command += fmt::format(" --texture {}", temple.texture);
  if (temple.gloss != usual.gloss) command += fmt::format(" --gloss {}", temple.gloss);
  if (temple.lighting != usual.lighting) command += " --lights per-view";
  if (temple.seed != usual.seed) command += fmt::format(" --seed {}", temple.seed);
  return command;
}

}  // namespace

Expected<ConformanceHashes> run_conformance(const ConformanceCase& conformance, Backend& backend,
                                            const fs::path& folder, Progress& progress) {
  QUORUM_TRY(synthesize_temple(folder / "scene", conformance.temple));
  const RunOptions options = options_of(conformance);
  QUORUM_ASSIGN(const Scene scene, read_scene(folder / "scene", options.files));
  QUORUM_ASSIGN(const Workspace workspace, Workspace::open(folder / "result"));
  Run run{scene, options, backend, workspace, progress};
  QUORUM_TRY(reconstruct(run));
  ConformanceHashes found;
  QUORUM_ASSIGN(found[0], hash_photographs(scene));
  found[1] = hash_cameras(scene);
  QUORUM_ASSIGN(found[2], hash_depth_maps(workspace.folder() / "depth"));
  QUORUM_ASSIGN(const std::string mesh, read_file(workspace.mesh_path()));
  found[3] = sha256(mesh);
  return found;
}

std::string_view first_difference(const ConformanceCase& conformance, const ConformanceHashes& found) {
  for (std::size_t stage = 0; stage < found.size(); ++stage)
    if (found[stage] != conformance.expected[stage]) return kConformanceStages[stage];
  return "";
}

std::string conformance_markdown() {
  std::string page =
      fmt::format("## Cases\n\nDepth maps of version {}, meshes of version {}.\n", kDepthVersion, kFusionVersion);
  for (const ConformanceCase& conformance : conformance_cases()) {
    page += fmt::format(
        "\n### {}\n\n```\nquorum synthesize SCENE {}\nquorum reconstruct SCENE -o OUT --maps all{}{}\n```\n\n",
        conformance.name, scene_command(conformance.temple), conformance.options.empty() ? "" : " ",
        conformance.options);
    page += "| result | SHA-256 |\n|---|---|\n";
    for (std::size_t stage = 0; stage < kConformanceStages.size(); ++stage)
      page += fmt::format("| {} | `{}` |\n", kConformanceStages[stage], conformance.expected[stage]);
  }
  return page;
}

}  // namespace quorum
