#include "engine/pipeline/workspace.h"

#include <gtest/gtest.h>

#include "tests/engine/io/io_test.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

DepthMap small_map() { return {Grid<float>(4, 3, 2.0F), Grid<float>(4, 3, 0.8F), Grid<float>(4, 3, 0.5F), {}}; }

TEST(Workspace, NormalsReadBackAndGoWithTheDepthMap) {
  const TemporaryFolder folder;
  const Workspace workspace = Workspace::open(folder.path()).value();
  DepthMap map = small_map();
  map.normal = Grid<Eigen::Vector3f>(4, 3, Eigen::Vector3f(0.0F, 0.6F, -0.8F));
  workspace.save_depth_map("view", map).value();
  EXPECT_EQ(workspace.load_normals("view", 4, 3).value().values, map.normal.values);
  expect_bad_input(workspace.load_normals("view", 5, 3), {"view.normal.pfm", "4 x 3", "5 x 3", "run `quorum depth`"});
  workspace.remove_depth_map("view");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "depth"));
}

TEST(Workspace, MissingNormalsAreToldWithTheRemedy) {
  const TemporaryFolder folder;
  const Workspace workspace = Workspace::open(folder.path()).value();
  workspace.save_depth_map("view", small_map()).value();
  expect_bad_input(workspace.load_normals("view", 4, 3), {"view.normal.pfm", "missing", "run `quorum depth`"});
}

}  // namespace
}  // namespace quorum
