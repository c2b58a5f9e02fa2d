// A device that is lost in the middle of a run.
#include <gtest/gtest.h>

#include <functional>

#include "engine/io/file.h"
#include "engine/io/scene_folder.h"
#include "engine/pipeline/cpu_backend.h"
#include "engine/pipeline/reconstruct.h"
#include "engine/pipeline/synthesize.h"
#include "tests/support/limited_backend.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// Is lost at the calls of these numbers, counted from 1 over all work on views, until it is renewed.
class LosingBackend : public LimitedBackend {
 public:
  LosingBackend(Backend& inner, std::vector<int> losses)
      : LimitedBackend(inner, std::size_t{1} << 30), losses_(std::move(losses)) {}

  int renewals = 0;
  int swept = 0;

  Expected<DepthMap> sweep_depth(const SweepTask& task) override {
    ++swept;
    return is_lost() ? Expected<DepthMap>(lost()) : LimitedBackend::sweep_depth(task);
  }
  Expected<Grid<float>> confirm_depths(const ConfirmTask& task) override {
    return is_lost() ? Expected<Grid<float>>(lost()) : LimitedBackend::confirm_depths(task);
  }
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) override {
    return is_lost() ? Expected<void>(lost()) : LimitedBackend::integrate(view, blocks);
  }
  Expected<void> renew() override {
    ++renewals;
    lost_ = false;
    return {};
  }

 private:
  static std::unexpected<Error> lost() { return failure(ErrorKind::kDevice, "the device was lost"); }
  bool is_lost() {
    ++calls_;
    lost_ = lost_ || std::ranges::count(losses_, calls_) > 0;
    return lost_;
  }

  std::vector<int> losses_;
  int calls_ = 0;
  bool lost_ = false;
};

class Renew : public testing::Test {
 protected:
  void SetUp() override {
    TempleOptions temple;
    temple.views = 5;
    temple.width = 64;
    synthesize_temple(folder_.path() / "scene", temple).value();
    scene_ = read_scene(folder_.path() / "scene", {}).value();
    options_.clean.min_component_triangles = 0;
    options_.min_confidence = 0.0F;
    CpuBackend cpu;
    ASSERT_TRUE(reconstruct_with(cpu, "whole"));
  }

  Expected<void> reconstruct_with(Backend& backend, const std::string& output) {
    const Workspace workspace = Workspace::open(folder_.path() / output).value();
    Progress progress;
    quorum::Run run{scene_, options_, backend, workspace, progress};
    auto done = reconstruct(run);
    report_ = run.report;
    return done;
  }
  std::string mesh(const std::string& output) { return read_file(folder_.path() / output / "mesh.ply").value_or(""); }

  TemporaryFolder folder_;
  Scene scene_;
  RunOptions options_;
  RunReport report_;
};

TEST_F(Renew, ADeviceThatIsLostOnceIsMadeAnewAndTheRunEndsInTheSameBytes) {
  ASSERT_FALSE(mesh("whole").empty());
  for (const int loss : {1, 3, 5, 7, 12}) {
    CpuBackend cpu;
    LosingBackend backend(cpu, {loss});
    const std::string output = "lost" + std::to_string(loss);
    const auto done = reconstruct_with(backend, output);
    ASSERT_TRUE(done) << loss << ": " << done.error().message;
    EXPECT_EQ(backend.renewals, 1);
    EXPECT_LE(backend.swept, 6) << "finished views are kept";
    EXPECT_EQ(mesh(output), mesh("whole")) << loss;
    EXPECT_EQ(static_cast<int>(report_.views.size()) + report_.kept_depth_maps, 5);
  }
}

TEST_F(Renew, ASecondLossEndsTheRunAndWhatIsFinishedIsKept) {
  CpuBackend cpu;
  LosingBackend backend(cpu, {2, 4});
  const auto done = reconstruct_with(backend, "twice");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, ErrorKind::kDevice);
  EXPECT_NE(done.error().message.find("the second time"), std::string::npos) << done.error().message;
  EXPECT_EQ(backend.renewals, 1);
  ASSERT_TRUE(reconstruct_with(cpu, "twice"));
  EXPECT_GE(report_.kept_depth_maps, 1);
  EXPECT_EQ(mesh("twice"), mesh("whole"));
}

}  // namespace
}  // namespace quorum
