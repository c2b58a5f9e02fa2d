#include "engine/pipeline/workspace.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/pipeline/workspace_lock.h"
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

TEST(Workspace, WritesTheMapsThatAreAskedForAndRemovesOthers) {
  const TemporaryFolder folder;
  const Workspace workspace = Workspace::open(folder.path()).value();
  workspace.save_depth_map("view", small_map(), "record").value();
  SavedFiles files{.correlation = false, .confidence = true, .normals = false, .previews = Previews::kNone};
  EXPECT_TRUE(workspace.has_maps("view", files));
  workspace.save_depth_map("view", small_map(), "record", files).value();
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "depth"))
    names.insert(entry.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"view.confidence.pfm", "view.depth.json", "view.depth.pfm"}));
  EXPECT_EQ(workspace.load_weighed_depth("view", 4, 3, false).value().confidence.values, small_map().confidence.values);
  expect_bad_input(workspace.load_weighed_depth("view", 4, 3, true), {"view.certainty.pfm", "missing"});
  expect_bad_input(workspace.load_depth_map("view", 4, 3), {"view.correlation.pfm", "missing", "maps all"});
  EXPECT_TRUE(workspace.has_maps("view", files));
  files.correlation = true;
  EXPECT_FALSE(workspace.has_maps("view", files));
}

TEST(Workspace, SmallPreviewsHaveAtMostSomePixelsInARow) {
  const TemporaryFolder folder;
  const Workspace workspace = Workspace::open(folder.path()).value();
  const auto width_of_preview = [&](Previews previews) {
    const Grid<float> map(1030, 3, 0.5F);
    workspace.save_depth_map("view", {map, map, map, {}}, "", {.previews = previews}).value();
    workspace.save_certainty("view", map, "", previews).value();
    const int width = read_image(folder.path() / "depth" / "view.depth.png").value().width;
    EXPECT_EQ(read_image(folder.path() / "depth" / "view.certainty.png").value().width, width);
    return width;
  };
  EXPECT_EQ(width_of_preview(Previews::kFull), 1030);
  EXPECT_EQ(width_of_preview(Previews::kSmall), 344);  // every third
}

TEST(Workspace, AFolderThatIsNoRunsKeepsItsMeshAndCloud) {
  for (const char* name : {"mesh.ply", "fused.ply", "run.json", "report.html"}) {
    const TemporaryFolder folder;
    write_text(folder.path() / name, "mine");
    expect_bad_input(Workspace::open(folder.path()), {name, "was not written by quorum", "choose another"});
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "depth"));
    std::filesystem::create_directories(folder.path() / "depth");
    write_text(folder.path() / "depth/a.depth.json", "{}");
    EXPECT_TRUE(Workspace::open(folder.path())) << "a run has worked here";
  }
}

TEST(Workspace, OfItsReportAFolderIsKnown) {
  const TemporaryFolder folder;
  write_text(folder.path() / "mesh.ply", "");
  write_text(folder.path() / "run.json", R"({"version": "0.1.0", "scene": {"photographs": {}}})");
  EXPECT_TRUE(Workspace::open(folder.path()));
}

TEST(Workspace, CutAndRemovedMapsAreNotWhole) {
  for (const char* map : {"depth", "correlation", "confidence", "normal"})
    for (const bool removed : {false, true}) {
      const TemporaryFolder folder;
      const Workspace workspace = Workspace::open(folder.path()).value();
      DepthMap made = small_map();
      made.normal = Grid<Eigen::Vector3f>(4, 3, Eigen::Vector3f(0.0F, 0.0F, -1.0F));
      workspace.save_depth_map("view", made, "record").value();
      workspace.save_certainty("view", made.depth, "record").value();
      ASSERT_TRUE(workspace.has_maps("view", {}));
      EXPECT_EQ(workspace.certainty_record("view"), "record");
      const auto path = folder.path() / "depth" / (std::string("view.") + map + ".pfm");
      removed ? static_cast<void>(std::filesystem::remove(path)) : std::filesystem::resize_file(path, 20);
      EXPECT_FALSE(workspace.has_maps("view", {})) << map;
      std::filesystem::resize_file(folder.path() / "depth/view.certainty.pfm", 20);
      EXPECT_EQ(workspace.certainty_record("view"),
                std::string(std::string(map) == "depth" && !removed ? "record" : ""));
    }
}

TEST(Workspace, ValuesThatNoRunWritesAreRefusedWithTheirPixel) {
  const TemporaryFolder folder;
  const Workspace workspace = Workspace::open(folder.path()).value();
  for (const float odd : {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    DepthMap made = small_map();
    made.depth.at(2, 1) = odd;
    workspace.save_depth_map("view", made, "record").value();
    expect_bad_input(workspace.load_depth("view", 4, 3), {"view.depth.pfm", "pixel (2, 1)", "restart"});
  }
}

TEST(WorkspaceLock, ALinkIsNotFollowed) {
  const TemporaryFolder folder;
  write_text(folder.path() / "mine", "text");
  std::filesystem::create_symlink(folder.path() / "mine", folder.path() / ".quorum.lock");
  expect_bad_input(WorkspaceLock::take(folder.path(), "depth"), {".quorum.lock", "cannot be made"});
  EXPECT_EQ(read_file(folder.path() / "mine").value(), "text");
}

}  // namespace
}  // namespace quorum
