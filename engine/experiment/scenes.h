// The scenes that experiments run on: the paper's data sets and rendered ones with known surface, where they are at
// hand, and synthetic temples, which are made here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/mesh/mesh.h"
#include "engine/pipeline/progress.h"
#include "engine/scene/scene.h"
#include "engine/synthetic/temple.h"

namespace quorum {

struct ExperimentScene {
  std::string name;                     ///< of a data set: its folder below --data
  std::optional<TempleOptions> temple;  ///< how it is made; none = a data set
  double background_level = 0.0;        ///< brightness (0..1) below which the background lies; 0 = it is not dark
  std::string figure_view;              ///< the view that figures show
  int quarter_turns = 0;                ///< to the left, that set it upright
};

/// The scenes of the paper's experiments, data sets first.
const std::vector<ExperimentScene>& paper_scenes();

/// The scene of that name, which must be one of them.
const ExperimentScene& find_scene(const std::vector<ExperimentScene>& scenes, std::string_view name);

/// A line that says what the photographs show: the name of a data set, the options of a synthetic scene.
std::string description(const ExperimentScene& scene);

/// A scene, ready to reconstruct.
struct OpenScene {
  const ExperimentScene* source = nullptr;
  Scene scene;
  std::optional<Mesh> truth;  ///< its exact surface, where known
};

/// Where scenes lie: data sets below one folder, synthetic scenes below another, into which they are rendered when
/// first asked for.
class SceneShelf {
 public:
  SceneShelf(std::filesystem::path data, std::filesystem::path synthetic)
      : data_(std::move(data)), synthetic_(std::move(synthetic)) {}

  /// True for synthetic scenes and for data sets whose folder exists.
  [[nodiscard]] bool has(const ExperimentScene& scene) const;
  /// Reads the scene, and renders it first if it is synthetic and not there. Fails as read_middlebury, read_ply and
  /// synthesize_temple do.
  [[nodiscard]] Expected<OpenScene> open(const ExperimentScene& scene, const Progress& progress) const;

 private:
  std::filesystem::path data_;  ///< empty = no data sets
  std::filesystem::path synthetic_;
};

}  // namespace quorum
