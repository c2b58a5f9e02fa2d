#include "engine/experiment/measures.h"

#include "tests/engine/experiment/tiny_catalog.h"

namespace quorum {
namespace {

/// A view that looks along z at a plane 2 units away.
OpenScene plane_scene(const std::vector<ExperimentScene>& scenes) {
  OpenScene open{&scenes[0], {}, std::nullopt};
  View view;
  view.name = "plane";
  view.width = 40;
  view.height = 30;
  view.camera.intrinsics << 100, 0, 20, 0, 100, 15, 0, 0, 1;
  open.scene.views = {view};
  open.scene.bounds = {{-1, -1, 1}, {1, 1, 3}};
  Mesh& truth = open.truth.emplace();
  for (const auto& [x, y] : {std::pair{-9.0F, -9.0F}, {9.0F, -9.0F}, {9.0F, 9.0F}, {-9.0F, 9.0F}})
    truth.vertices.push_back({.position = {x, y, 2.0F}});
  truth.triangles = {{0, 1, 2}, {0, 2, 3}};
  return open;
}

DepthMap plane_map() { return {Grid<float>(40, 30, 2.0F), Grid<float>(40, 30, 0.8F), Grid<float>(40, 30, 0.5F), {}}; }

DepthMeasures measure(const DepthMap& map) {
  const auto scenes = tiny_scenes();
  const OpenScene scene = plane_scene(scenes);
  const TemporaryFolder folder;
  const auto workspace = Workspace::open(folder.path()).value();
  EXPECT_TRUE(workspace.save_depth_map("plane", map));
  RunReport report;
  report.views.push_back({"plane", {}, 1200, 5000, 1100});
  return measure_depth_maps(scene, {}, workspace, report, Progress()).value();
}

TEST(MeasureDepthMaps, AnExactPlaneIsSmoothAndRight) {
  const DepthMeasures measures = measure(plane_map());
  EXPECT_EQ(measures.views, 1);
  EXPECT_EQ(measures.swept_pixels, 1200U);
  EXPECT_EQ(measures.valid_pixels, 1100U);
  EXPECT_EQ(measures.depth_samples, 5000U);
  EXPECT_EQ(measures.loose_pixels, 0U);
  EXPECT_EQ(measures.roughness, 0.0);
  EXPECT_NEAR(measures.correlation, 0.8, 1e-6);
  EXPECT_NEAR(measures.confidence, 0.5, 1e-6);
  EXPECT_NEAR(measures.median_error.value(), 0.0, 1e-6);
  EXPECT_EQ(measures.wrong_share.value(), 0.0);
}

TEST(MeasureDepthMaps, NoiseIsRoughAndOutliersAreLooseAndWrong) {
  DepthMap map = plane_map();
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; x += 2) map.depth.at(x, y) = 2.0005F;  // footprint 0.02: a bend of 0.05 footprints
  map.depth.at(9, 9) = 2.9F;                                       // alone, and compared with the truth
  const DepthMeasures measures = measure(map);
  EXPECT_NEAR(measures.roughness, 0.05, 0.002);
  EXPECT_EQ(measures.loose_pixels, 1U);
  EXPECT_NEAR(measures.wrong_share.value(), 1.0 / (14 * 10), 1e-9);
  EXPECT_LT(measures.median_error.value(), 0.0006);
}

TEST(ScoreMesh, AnEmptyMeshHasNoScore) {
  const auto scenes = tiny_scenes();
  const MeshScore score = score_mesh(plane_scene(scenes), {}).value();
  EXPECT_EQ(score.vertices, 0U);
  EXPECT_FALSE(score.evaluation);
}

}  // namespace
}  // namespace quorum
