// Experiments about what the paper leaves open, and about the program beside the paper.
#include <utility>

#include "engine/experiment/catalog_parts.h"

namespace quorum {

Experiment window_model_experiment() {
  Experiment experiment{"model", "Windows along the image axes, or along the plane of equal depth", {}, {}};
  for (const char* scene : {"templeSparseRing", "templeRing", "dinoSparseRing", "bunnyHemi", "dragonRing",
                            "synthetic16", "synthetic24", "synthetic47"}) {
    experiment.runs.push_back(axis_run(scene, "axis"));
    experiment.runs.push_back(paper_run(scene, "plane"));
  }
  experiment.figures.push_back({"model-temple",
                                4,
                                {{2, Picture::kDepth, "axis, depth"},
                                 {3, Picture::kDepth, "plane, depth"},
                                 {2, Picture::kMesh, "axis, mesh"},
                                 {3, Picture::kMesh, "plane, mesh"}}});
  return experiment;
}

Experiment weights_experiment() {
  Experiment experiment{"weights", "What a depth's weight is made of (2.2)", {}, {}};
  for (const char* scene : {"dragonRing", "bunnyHemi", "synthetic24"}) {
    const auto add = [&](const char* label, bool confidence, bool slant, bool border) {
      RunSettings run = default_run(scene, label);
      run.options.fusion.weigh_confidence = confidence;
      run.options.fusion.weigh_slant = slant;
      run.options.fusion.weigh_border = border;
      experiment.runs.push_back(run);
    };
    add("confidence, slant, border", true, true, true);
    add("without confidence", false, true, true);
    add("without slant", true, false, true);
    add("without border", true, true, false);
    add("none", false, false, false);
  }
  experiment.figures.push_back({"weights-dragon",
                                3,
                                {{0, Picture::kError, "all factors, error"},
                                 {3, Picture::kError, "without border, error"},
                                 {4, Picture::kError, "none, error"}}});
  return experiment;
}

Experiment view_rule_experiment() {
  Experiment experiment{"views", "Neighbors by the angle between optical axes (4.1), or by parallax", {}, {}};
  for (const char* scene : {"templeSparseRing", "dinoSparseRing", "dragonRing", "synthetic16"}) {
    for (const auto& [label, rule] : {std::pair{"angle", ViewRule::kAngle}, {"parallax", ViewRule::kParallax}}) {
      RunSettings run = default_run(scene, label);
      run.options.views.rule = rule;
      experiment.runs.push_back(run);
    }
  }
  experiment.figures.push_back(
      rows_of_pictures("views-temple", {0, 1}, {Picture::kDepth, Picture::kMesh}, {"angle", "parallax"}));
  return experiment;
}

Experiment defaults_experiment() {
  Experiment experiment{"defaults", "The program's defaults beside the paper's settings", {}, {}};
  for (const char* scene :
       {"synthetic16", "synthetic24", "synthetic47", "bunnyHemi", "dragonRing", "templeSparseRing", "templeRing"}) {
    experiment.runs.push_back(axis_run(scene, "paper, axis windows"));
    experiment.runs.push_back(paper_run(scene, "paper, plane windows"));
    experiment.runs.push_back(default_run(scene, "defaults"));
  }
  experiment.figures.push_back({"defaults-dragon",
                                4,
                                {{13, Picture::kPhoto, "photograph"},
                                 {12, Picture::kError, "paper, axis windows"},
                                 {13, Picture::kError, "paper, plane windows"},
                                 {14, Picture::kError, "defaults"}}});
  experiment.figures.push_back({"defaults-temple",
                                3,
                                {{18, Picture::kMesh, "paper, axis windows"},
                                 {19, Picture::kMesh, "paper, plane windows"},
                                 {20, Picture::kMesh, "defaults"}}});
  return experiment;
}

}  // namespace quorum
