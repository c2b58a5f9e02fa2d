#include <gtest/gtest.h>

#include <set>

#include "engine/experiment/experiment.h"

namespace quorum {
namespace {

TEST(PaperCatalog, EveryRunIsPossibleAndNamedOnce) {
  const Catalog& catalog = paper_catalog();
  std::set<std::string> names;
  for (const Experiment& experiment : catalog.experiments) {
    EXPECT_TRUE(names.insert(experiment.name).second) << experiment.name;
    EXPECT_FALSE(experiment.question.empty()) << experiment.name;
    EXPECT_GE(experiment.runs.size(), 2U) << experiment.name;
    std::set<std::string> labels;
    for (const RunSettings& run : experiment.runs) {
      EXPECT_EQ(find_scene(catalog.scenes, run.scene).name, run.scene);
      EXPECT_TRUE(run.options.check().has_value()) << run.scene << ", " << run.label;
      EXPECT_TRUE(labels.insert(run.scene + ", " + run.label).second) << run.scene << ", " << run.label;
    }
  }
}

TEST(PaperCatalog, EveryExperimentHasRunsThatNeedNoData) {
  const Catalog& catalog = paper_catalog();
  for (const Experiment& experiment : catalog.experiments) {
    bool found = false;
    for (const RunSettings& run : experiment.runs)
      found = found || find_scene(catalog.scenes, run.scene).temple.has_value();
    EXPECT_TRUE(found) << experiment.name;
  }
}

TEST(PaperCatalog, FiguresShowRunsOfTheirExperiment) {
  std::set<std::string> names;
  for (const Experiment& experiment : paper_catalog().experiments) {
    for (const Figure& figure : experiment.figures) {
      EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
      EXPECT_GE(figure.columns, 1);
      EXPECT_GE(figure.panels.size(), 2U);
      for (const Figure::Panel& panel : figure.panels) EXPECT_LT(panel.run, experiment.runs.size()) << figure.name;
    }
  }
}

TEST(PaperOptions, AreThoseOfTheText) {
  const RunOptions options = paper_options("templeRing");
  EXPECT_FALSE(options.confirm);
  EXPECT_EQ(options.views.neighbor_count, 4);
  EXPECT_EQ(options.views.min_angle_deg, 4.0);
  EXPECT_EQ(options.sweep.window, 5);
  EXPECT_EQ(options.sweep.threshold, 0.6F);
  EXPECT_EQ(options.sweep.min_votes, 2);
  EXPECT_EQ(options.sweep.depth_step, 0.0025);
  EXPECT_EQ(options.sweep.refinement, 10);
  EXPECT_EQ(options.mask_below, 0.19);
  EXPECT_EQ(default_options("templeRing").mask_below, 0.19);
  EXPECT_FALSE(default_options("templeRing").confirm);
  EXPECT_EQ(default_options("synthetic24").mask_below, 0.0);
}

}  // namespace
}  // namespace quorum
