#include "engine/experiment/missed_truth.h"

#include <gtest/gtest.h>

#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// A rectangle at depth 2 from x0 to x1, y -1 to 1.
Mesh wall(float x0, float x1) {
  Mesh mesh;
  for (const float y : {-1.0F, 1.0F})
    for (const float x : {x0, x1}) mesh.vertices.emplace_back().position = {x, y, 2.0F};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  return mesh;
}

/// A wall before one camera. Its quarters from the left: reconstructed, right depths alone, wrong ones, none.
TEST(MissedTruth, EachPieceIsCountedWhereItWasLost) {
  const TemporaryFolder folder;
  const Workspace workspace = Workspace::open(folder.path()).value();
  Scene scene;
  View& view = scene.views.emplace_back();
  view.name = std::string("wall");
  view.width = view.height = 401;
  view.camera.intrinsics << 400, 0, 200, 0, 400, 200, 0, 0, 1;
  EvaluateOptions options;
  options.threshold = 0.01;
  options.samples = 10000;
  options.seen_by = 1;
  const Mesh truth = wall(-1, 1);
  EXPECT_FALSE(find_missed_truth(scene, workspace, truth, nullptr, truth, options)) << "there is no depth map";

  DepthMap map;
  map.depth = map.correlation = map.confidence = Grid<float>(401, 401);
  for (int y = 0; y < 401; ++y)
    for (int x = 0; x < 401; ++x) map.depth.at(x, y) = x < 200 ? 2.0F : x < 300 ? 2.1F : 0.0F;
  workspace.save_depth_map(view.name, map).value();
  const auto missed = find_missed_truth(scene, workspace, wall(-1, -0.5F), nullptr, truth, options).value();
  EXPECT_EQ(missed.samples, 10000U);
  EXPECT_NEAR(static_cast<double>(missed.never_depth), 2500, 30);
  EXPECT_NEAR(static_cast<double>(missed.wrong_depth), 2500, 30);
  EXPECT_EQ(missed.in_fusion, 0U);
  EXPECT_NEAR(static_cast<double>(missed.in_clean_up), 2450, 30);

  const Mesh uncleaned = wall(-1, -0.25F);
  const auto known = find_missed_truth(scene, workspace, wall(-1, -0.5F), &uncleaned, truth, options).value();
  EXPECT_NEAR(static_cast<double>(known.in_fusion), 1200, 30);
  EXPECT_NEAR(static_cast<double>(known.in_clean_up), 1250, 30);
  EXPECT_EQ(known.missed(), missed.missed());
}

}  // namespace
}  // namespace quorum
