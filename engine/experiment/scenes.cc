#include "engine/experiment/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/check.h"
#include "engine/io/file.h"
#include "engine/io/middlebury.h"
#include "engine/io/ply.h"
#include "engine/pipeline/synthesize.h"

namespace quorum {
namespace {

ExperimentScene data_set(std::string name, double background_level, std::string figure_view, int quarter_turns) {
  return {std::move(name), std::nullopt, background_level, std::move(figure_view), quarter_turns};
}

ExperimentScene synthetic(std::string name, const TempleOptions& options) {
  constexpr double kBackground = 0.06;  // its background is black with noise of 1.5 of 255 levels
  return {std::move(name), options, kBackground, "temple0002", 0};
}

/// Renders a synthetic scene into folder unless it is there.
Expected<void> provide(const std::filesystem::path& folder, const ExperimentScene& scene, const Progress& progress) {
  const std::filesystem::path note = folder / "description.txt";  // written last
  if (const auto found = read_file(note); found && *found == description(scene)) return {};
  std::error_code ignored;
  std::filesystem::remove(note, ignored);
  QUORUM_TRY(synthesize_temple(folder, *scene.temple, progress));
  return write_file(note, description(scene));
}

}  // namespace

const std::vector<ExperimentScene>& paper_scenes() {
  constexpr double kMiddleburyBackground = 0.19;  // the dino's README
  static const std::vector<ExperimentScene> kScenes = {
      data_set("templeSparseRing", kMiddleburyBackground, "templeSR0001", 1),
      data_set("templeRing", kMiddleburyBackground, "templeR0001", 1),
      data_set("templeFull", kMiddleburyBackground, "temple0057", 1),
      data_set("dinoSparseRing", kMiddleburyBackground, "dinoSR0002", 1),
      data_set("dinoRing", kMiddleburyBackground, "dinoR0006", 1),
      data_set("bunnyHemi", 0.0, "bunnyHemi0002", 0),
      data_set("dragonRing", 0.0, "dragonRing0002", 0),
      synthetic("synthetic16", {.views = 16}),
      synthetic("synthetic24", {.views = 24}),
      synthetic("synthetic47", {.views = 47}),
      synthetic("synthetic128", {.views = 128}),
      synthetic("synthetic24-weak", {.views = 24, .texture = 0.3}),
      synthetic("synthetic24-plain", {.views = 24, .texture = 0.0}),
      synthetic("synthetic24-gloss", {.views = 24, .gloss = 0.6}),
      synthetic("synthetic24-lights", {.views = 24, .lighting = Lighting::kPerView}),
      synthetic("synthetic24-skull", {.views = 24, .texture = 0.3, .gloss = 0.6, .lighting = Lighting::kPerView}),
  };
  return kScenes;
}

const ExperimentScene& find_scene(const std::vector<ExperimentScene>& scenes, std::string_view name) {
  const auto found = std::ranges::find(scenes, name, &ExperimentScene::name);
  QUORUM_CHECK_EQ(found != scenes.end(), true);
  return *found;
}

std::string description(const ExperimentScene& scene) {
  if (!scene.temple) return scene.name;
  const TempleOptions& options = *scene.temple;
  return fmt::format("temple, {} views on a {}, width {}, noise {}, texture {}, gloss {}, lights {}, seed {}",
                     options.views, options.path == CameraPath::kRing ? "ring" : "hemisphere", options.width,
                     options.noise, options.texture, options.gloss,
                     options.lighting == Lighting::kFixed ? "fixed" : "per view", options.seed);
}

bool SceneShelf::has(const ExperimentScene& scene) const {
  std::error_code ignored;
  return scene.temple || (!data_.empty() && std::filesystem::is_directory(data_ / scene.name, ignored));
}

Expected<OpenScene> SceneShelf::open(const ExperimentScene& scene, const Progress& progress) const {
  const std::filesystem::path folder = (scene.temple ? synthetic_ : data_) / scene.name;
  if (scene.temple) QUORUM_TRY(provide(folder, scene, progress));
  QUORUM_ASSIGN(auto read, read_middlebury(folder, std::nullopt, {}));
  OpenScene open{&scene, std::move(read), std::nullopt};
  std::error_code ignored;
  const std::filesystem::path truth = folder / "gt.ply";
  if (!std::filesystem::exists(truth, ignored)) return open;
  QUORUM_ASSIGN(auto surface, read_ply(truth, open.scene.offset));
  open.truth = std::move(surface);
  return open;
}

}  // namespace quorum
