#include "engine/experiment/run_maker.h"

#include <atomic>

#include "engine/io/file.h"
#include "tests/engine/experiment/tiny_catalog.h"

namespace quorum {
namespace {

class RunMakerTest : public testing::Test {
 protected:
  RunMaker maker() { return {folder_.path(), scenes_, SceneShelf({}, folder_.path() / "scenes"), backend_, progress_}; }

  TemporaryFolder folder_;
  std::vector<ExperimentScene> scenes_ = tiny_scenes();
  CpuBackend backend_;
  NotedProgress progress_;
};

TEST_F(RunMakerTest, MeasuresARunAndKeepsItsPictures) {
  RunMaker runs = maker();
  const auto record = runs.run(tiny_run("whole"));
  ASSERT_TRUE(record) << record.error().message;
  EXPECT_TRUE(runs.was_made());
  EXPECT_EQ(record->scene, "tiny");
  EXPECT_EQ(record->problem, "");
  EXPECT_EQ(record->depth.views, 8);
  EXPECT_GT(record->depth.valid_pixels, 500U);
  EXPECT_GE(record->depth.swept_pixels, record->depth.valid_pixels);
  EXPECT_GE(record->depth.depth_samples, record->depth.swept_pixels);
  EXPECT_GE(record->depth.valid_pixels, record->depth.loose_pixels);
  EXPECT_GT(record->depth.correlation, 0.6);
  EXPECT_GT(record->depth.median_error.value(), 0.0);
  EXPECT_LT(record->depth.median_error.value(), 0.01);
  EXPECT_GT(record->mesh.vertices, 100U);
  ASSERT_TRUE(record->mesh.evaluation);
  EXPECT_GT(record->mesh.evaluation->completeness, 0.02);
  EXPECT_GE(record->cpu_seconds, record->depth_cpu_seconds);
  EXPECT_EQ(record->voxel_size, 0.003);
  for (const Picture picture : {Picture::kPhoto, Picture::kDepth, Picture::kCorrelation, Picture::kConfidence,
                                Picture::kMesh, Picture::kColor, Picture::kMeshConfidence, Picture::kError})
    EXPECT_TRUE(std::filesystem::exists(runs.picture_path(*record, picture))) << to_string(picture);
}

TEST_F(RunMakerTest, ARunIsMadeOnce) {
  const auto first = maker().run(tiny_run("first"));
  ASSERT_TRUE(first) << first.error().message;
  RunMaker later = maker();
  const auto second = later.run(tiny_run("under another label"));
  ASSERT_TRUE(second);
  EXPECT_FALSE(later.was_made());
  EXPECT_EQ(record_json(*first), record_json(*second));

  RunSettings other = tiny_run("other threshold");
  other.options.sweep.threshold = 0.7F;
  const auto third = later.run(other);
  ASSERT_TRUE(third);
  EXPECT_TRUE(later.was_made());
  EXPECT_LT(third->depth.valid_pixels, first->depth.valid_pixels);
}

TEST_F(RunMakerTest, RunsThatDifferInFusionShareTheirDepthMaps) {
  RunMaker runs = maker();
  const auto first = runs.run(tiny_run("first"));
  ASSERT_TRUE(first) << first.error().message;
  RunSettings settings = tiny_run("coarser");
  settings.options.fusion.voxel_size = 0.004;
  const auto second = runs.run(settings);
  ASSERT_TRUE(second);
  EXPECT_TRUE(runs.was_made());
  EXPECT_EQ(second->depth_cpu_seconds, first->depth_cpu_seconds);
  EXPECT_EQ(second->depth.valid_pixels, first->depth.valid_pixels);
  EXPECT_LT(second->mesh.vertices, first->mesh.vertices);
}

TEST_F(RunMakerTest, FewerThanThreeViewsGiveNoSurface) {
  RunSettings settings = tiny_run("two views");
  settings.first_views = 2;
  const auto record = maker().run(settings);
  ASSERT_TRUE(record) << record.error().message;
  EXPECT_EQ(record->problem, "no surface: none of 2 views has two neighbors");
  EXPECT_EQ(record->mesh.vertices, 0U);
}

TEST_F(RunMakerTest, BrokenRecordsAreMadeAgain) {
  ASSERT_TRUE(maker().run(tiny_run("first")));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "runs"))
    if (entry.is_regular_file()) write_text(entry.path(), "{\"scene\": \"tiny\"");
  RunMaker runs = maker();
  ASSERT_TRUE(runs.run(tiny_run("first")));
  EXPECT_TRUE(runs.was_made());
}

/// Asks to stop from some question on.
class StoppingProgress : public Progress {
 public:
  explicit StoppingProgress(int asked_before) : asked_before_(asked_before) {}
  [[nodiscard]] bool stop_requested() const override { return ++asked_ > asked_before_; }
  [[nodiscard]] int asked() const { return asked_; }

 private:
  int asked_before_;
  mutable std::atomic<int> asked_ = 0;
};

TEST_F(RunMakerTest, ARunEndsBeforeTheNextViewOfWhateverStage) {
  const auto run = [&](const std::string& name, Progress& progress) {
    const auto folder = folder_.path() / name;
    return RunMaker(folder, scenes_, SceneShelf({}, folder / "scenes"), backend_, progress).run(tiny_run("whole"));
  };
  StoppingProgress never(1 << 30);
  ASSERT_TRUE(run("never", never));
  constexpr int kStages = 4;  // rendered, swept, measured, fused
  EXPECT_GE(never.asked(), kStages * 8) << "once for each of 8 views";
  for (int quarter = 0; quarter < 4; ++quarter) {
    StoppingProgress wish(never.asked() * quarter / 4);
    const auto stopped = run(std::to_string(quarter), wish);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::kStopped) << stopped.error().message;
    EXPECT_EQ(wish.asked(), never.asked() * quarter / 4 + 1) << "went on after it was told";
  }
}

TEST_F(RunMakerTest, ScenesWithTheSameCamerasShareNothing) {
  ExperimentScene glossy = scenes_[1];
  glossy.name = "glossy";
  glossy.temple->gloss = 0.8;
  scenes_.push_back(glossy);
  RunMaker runs = maker();
  const auto first = runs.run(tiny_run("first"));
  ASSERT_TRUE(first) << first.error().message;
  RunSettings settings = tiny_run("first");
  settings.scene = "glossy";
  const auto second = runs.run(settings);
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_TRUE(runs.was_made());
  EXPECT_NE(second->depth.correlation, first->depth.correlation);
}

TEST_F(RunMakerTest, ScenesOfOtherOptionsAreRenderedAgain) {
  const auto first = maker().run(tiny_run("first"));
  ASSERT_TRUE(first) << first.error().message;
  const auto photograph = folder_.path() / "scenes" / "tiny" / "temple0001.png";
  const std::string before = read_file(photograph).value();
  scenes_[1].temple->gloss = 0.5;
  RunMaker runs = maker();
  const auto second = runs.run(tiny_run("first"));
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_TRUE(runs.was_made());
  EXPECT_NE(read_file(photograph).value(), before);
  EXPECT_NE(second->depth.correlation, first->depth.correlation);
}

TEST(RunRecord, IsReadAsItWasWritten) {
  RunRecord record;
  record.scene = "tiny";
  record.identity = R"({"depth":1,"fusion":2})";
  record.device = "CPU";
  record.wall_seconds = 1.5;
  record.cpu_seconds = 2.5;
  record.problem = "none";
  record.depth.views = 3;
  record.depth.roughness = 0.25;
  record.depth.wrong_share = 0.125;
  record.mesh.vertices = 7;
  const std::string plain = record_json(record);
  EXPECT_EQ(record_json(read_record(plain).value()), plain);
  record.mesh.evaluation = Evaluation{.accuracy = 0.1,
                                      .median_accuracy = 0.2,
                                      .mean_accuracy = 0.3,
                                      .completeness = 0.4,
                                      .f_scores = {{0.5, 0.6, 0.7, 0.8}}};
  const std::string evaluated = record_json(record);
  EXPECT_NE(evaluated, plain);
  EXPECT_EQ(record_json(read_record(evaluated).value()), evaluated);
}

TEST(RunRecord, OtherTextIsRefused) {
  for (const char* text : {"", "{}", "[1, 2]", "{\"scene\": 3}", "nonsense"})
    EXPECT_EQ(read_record(text).error().kind, ErrorKind::kInput) << text;
}

}  // namespace
}  // namespace quorum
