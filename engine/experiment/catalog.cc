// The experiments of section 4 of the paper, one function each.
#include <fmt/format.h>

#include <utility>

#include "engine/experiment/catalog_parts.h"
#include "engine/experiment/experiment.h"

namespace quorum {
namespace {

Experiment window_size() {
  Experiment experiment{"window", "Window size (4.2, figure 2)", {}, {}};
  const auto add = [&](const char* scene, int window) {
    RunSettings run = paper_run(scene, fmt::format("{} x {}", window, window));
    run.options.sweep.window = window;
    experiment.runs.push_back(run);
  };
  for (const int window : {5, 9}) add("templeRing", window);
  for (const char* scene : {"dragonRing", "synthetic24"})
    for (const int window : {3, 5, 7, 9, 11}) add(scene, window);
  const std::vector<Picture> pictures = {Picture::kDepth, Picture::kCorrelation, Picture::kConfidence};
  experiment.figures.push_back(rows_of_pictures("window-temple", {0, 1}, pictures, {"5 x 5", "9 x 9"}));
  experiment.figures.push_back(rows_of_pictures("window-synthetic", {8, 10}, pictures, {"5 x 5", "9 x 9"}));
  return experiment;
}

Experiment threshold() {
  Experiment experiment{"threshold", "Threshold of a vote (4.5, figure 5)", {}, {}};
  for (const char* scene : {"templeSparseRing", "dragonRing", "synthetic24-skull"}) {
    for (const double threshold : {0.4, 0.5, 0.6, 0.7, 0.8}) {
      RunSettings run = paper_run(scene, fmt::format("{:.1f}", threshold));
      run.options.sweep.threshold = static_cast<float>(threshold);
      experiment.runs.push_back(run);
    }
  }
  const std::vector<Picture> pictures = {Picture::kDepth, Picture::kConfidence};
  experiment.figures.push_back(rows_of_pictures("threshold-synthetic", {12, 10}, pictures, {"0.6", "0.4"}));
  experiment.figures.push_back(rows_of_pictures("threshold-temple", {2, 0}, pictures, {"0.6", "0.4"}));
  return experiment;
}

Experiment neighbors() {
  Experiment experiment{"neighbors", "Number of neighbor views, and votes that make a depth valid (4.1, 2.1)", {}, {}};
  for (const char* scene : {"dragonRing", "synthetic47"}) {
    for (const int count : {2, 4, 6, 8}) {
      RunSettings run = paper_run(scene, fmt::format("k = {}, 2 votes", count));
      run.options.views.neighbor_count = count;
      experiment.runs.push_back(run);
    }
    for (const int votes : {1, 3}) {
      RunSettings run = paper_run(scene, fmt::format("k = 4, {} vote{}", votes, votes == 1 ? "" : "s"));
      run.options.sweep.min_votes = votes;
      experiment.runs.push_back(run);
    }
  }
  experiment.figures.push_back({"neighbors-synthetic",
                                3,
                                {{10, Picture::kError, "1 vote of 4"},
                                 {7, Picture::kError, "2 votes of 4"},
                                 {11, Picture::kError, "3 votes of 4"}}});
  return experiment;
}

Experiment density() {
  Experiment experiment{"density", "Density of views (4.3, figures 3 and 7, table 2)", {}, {}};
  for (const char* scene : {"templeSparseRing", "templeRing", "templeFull", "dinoSparseRing", "dinoRing", "synthetic16",
                            "synthetic47", "synthetic128"}) {
    const ExperimentScene& source = find_scene(paper_scenes(), scene);
    experiment.runs.push_back(
        paper_run(scene, source.temple ? fmt::format("{} views", source.temple->views) : "all views"));
  }
  for (const int views : {2, 3}) {
    RunSettings run = paper_run("synthetic16", fmt::format("the first {} views", views));
    run.first_views = views;
    experiment.runs.push_back(run);
  }
  experiment.figures.push_back({"density-temple",
                                4,
                                {{1, Picture::kPhoto, "photograph"},
                                 {0, Picture::kMesh, "16 views"},
                                 {1, Picture::kMesh, "47 views"},
                                 {2, Picture::kMesh, "312 views"}}});
  experiment.figures.push_back(
      {"density-dino",
       3,
       {{4, Picture::kPhoto, "photograph"}, {3, Picture::kMesh, "16 views"}, {4, Picture::kMesh, "48 views"}}});
  experiment.figures.push_back({"density-synthetic",
                                4,
                                {{6, Picture::kPhoto, "photograph"},
                                 {5, Picture::kError, "16 views, error"},
                                 {6, Picture::kError, "47 views, error"},
                                 {7, Picture::kError, "128 views, error"}}});
  return experiment;
}

Experiment texture() {
  Experiment experiment{"texture", "Weak texture, gloss and changing light (4.4, 4.5, figure 4)", {}, {}};
  const std::vector<std::pair<const char*, const char*>> scenes = {
      {"synthetic24", "stone texture"},    {"synthetic24-weak", "texture 0.3"},   {"synthetic24-plain", "no texture"},
      {"synthetic24-gloss", "gloss 0.6"},  {"synthetic24-lights", "lights move"}, {"synthetic24-skull", "all three"},
      {"dinoSparseRing", "white plaster"}, {"dinoRing", "white plaster"}};
  for (const auto& [scene, label] : scenes) experiment.runs.push_back(paper_run(scene, label));
  Figure& figure = experiment.figures.emplace_back(Figure{"texture", 4, {}});
  for (const Picture picture : {Picture::kPhoto, Picture::kError})
    for (const std::size_t run : {0U, 1U, 2U, 5U})
      figure.panels.push_back({run, picture, fmt::format("{}, {}", scenes[run].second, to_string(picture))});
  return experiment;
}

Experiment silhouettes() {
  Experiment experiment{"silhouettes", "Silhouettes, with and without a background mask (4.6, figure 6)", {}, {}};
  for (const char* scene : {"templeRing", "dinoSparseRing", "synthetic24"}) {
    RunSettings whole = paper_run(scene, "no mask");
    whole.options.mask_below = 0.0;
    experiment.runs.push_back(whole);
    RunSettings masked = paper_run(scene, "background left out");
    masked.options.mask_below = find_scene(paper_scenes(), scene).background_level;
    experiment.runs.push_back(masked);
  }
  const std::vector<Picture> pictures = {Picture::kDepth, Picture::kConfidence, Picture::kMesh};
  experiment.figures.push_back(rows_of_pictures("silhouettes-temple", {0, 1}, pictures, {"no mask", "mask"}));
  return experiment;
}

Experiment steps() {
  Experiment experiment{"steps", "Depth step and second pass (4.1)", {}, {}};
  struct Step {
    const char* label;
    double depth_step;   // scene units; 0 = automatic
    double step_pixels;  // of the automatic step
    int refinement;
  };
  constexpr Step kSteps[] = {{"5 mm, second pass", 0.005, 0.5, 10},    {"2.5 mm", 0.0025, 0.5, 1},
                             {"2.5 mm, second pass", 0.0025, 0.5, 10}, {"1 mm", 0.001, 0.5, 1},
                             {"1 mm, second pass", 0.001, 0.5, 10},    {"0.25 mm", 0.00025, 0.5, 1},
                             {"1 pixel, second pass", 0.0, 1.0, 10},   {"0.5 pixel", 0.0, 0.5, 1},
                             {"0.5 pixel, second pass", 0.0, 0.5, 10}, {"0.25 pixel, second pass", 0.0, 0.25, 10}};
  for (const char* scene : {"synthetic24", "dragonRing"}) {
    for (const Step& step : kSteps) {
      const bool is_costly = step.depth_step == 0.00025 || step.step_pixels == 0.25;
      if (is_costly && scene != std::string_view("synthetic24")) continue;
      RunSettings run = paper_run(scene, step.label);
      run.options.sweep.depth_step = step.depth_step;
      run.options.sweep.step_pixels = step.step_pixels;
      run.options.sweep.refinement = step.refinement;
      experiment.runs.push_back(run);
    }
  }
  experiment.figures.push_back(
      rows_of_pictures("steps-synthetic", {1, 2, 8}, {Picture::kDepth}, {"2.5 mm", "second pass", "0.5 pixel"}));
  return experiment;
}

}  // namespace

const Catalog& paper_catalog() {
  static const Catalog kCatalog = {
      paper_scenes(),
      {density(), window_size(), threshold(), neighbors(), texture(), silhouettes(), steps(), window_model_experiment(),
       weights_experiment(), view_rule_experiment(), defaults_experiment()}};
  return kCatalog;
}

}  // namespace quorum
