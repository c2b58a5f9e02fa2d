// What an experiment is: runs of the whole method that differ in one thing, and figures made of their pictures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/experiment/scenes.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// One run of the method.
struct RunSettings {
  std::string scene;    ///< name of one of the catalog's scenes
  std::string label;    ///< what sets the run apart in its experiment
  int first_views = 0;  ///< only that many views of the scene, from the first; 0 = all
  RunOptions options;
};

/// A picture that a run leaves of its scene's figure view.
enum class Picture { kPhoto, kDepth, kCorrelation, kConfidence, kMesh, kColor, kMeshConfidence, kError };

/// File name of a picture, without extension.
std::string_view to_string(Picture picture);

/// Pictures of runs, side by side.
struct Figure {
  struct Panel {
    std::size_t run = 0;  ///< index into Experiment::runs
    Picture picture = Picture::kMesh;
    std::string caption;
  };
  std::string name;  ///< file name without extension
  int columns = 2;
  std::vector<Panel> panels;
};

struct Experiment {
  std::string name;      ///< as typed
  std::string question;  ///< what it asks, with the paper's section
  std::vector<RunSettings> runs;
  std::vector<Figure> figures;
};

/// Scenes, and what is done with them.
struct Catalog {
  std::vector<ExperimentScene> scenes;
  std::vector<Experiment> experiments;
};

/// The paper's settings (4.1): depth samples 2.5 mm apart and a second pass at a tenth, four neighbors, 5 × 5 windows,
/// threshold 0.6, two votes; windows follow the plane of equal depth, as half of the photographs are upside down. The
/// background is left out where it is dark, as in 4.6. scene: name of one of
/// paper_scenes().
RunOptions paper_options(const std::string& scene);

/// The program's defaults, with the same background mask.
RunOptions default_options(const std::string& scene);

/// The experiments after section 4 of the paper.
const Catalog& paper_catalog();

}  // namespace quorum
