#include "engine/pipeline/view_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include "engine/pipeline/cpu_backend.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

class StoppingProgress : public Progress {
 public:
  void step() override { ++steps; }
  [[nodiscard]] bool stop_requested() const override { return steps >= stop_after; }

  int steps = 0;
  int stop_after = 1000;
};

class ViewLoop : public testing::Test {
 protected:
  ViewLoop() {
    scene_.views.resize(5);
    for (int view = 0; view < 5; ++view)
      scene_.views[static_cast<std::size_t>(view)].name = "view" + std::to_string(view);
  }

  Expected<void> loop(int bad_read = -1, int bad_work = -1, int bad_write = -1) {
    const auto fail = [](const char* what) { return failure(ErrorKind::kInput, what); };
    const auto read = [&, fail](int view) -> Expected<int> {
      if (view == bad_read) return fail("read");
      return 10 * view;
    };
    const auto work = [&, fail](int view, int input) -> Expected<int> {
      EXPECT_EQ(std::this_thread::get_id() == main_, in_flight_.workers == 1);
      if (in_flight_.workers > 1) std::this_thread::sleep_for(std::chrono::milliseconds(view % 2 == 0 ? 30 : 1));
      if (view == bad_work) return fail("work");
      const std::lock_guard lock(mutex_);
      worked_.push_back(view);
      return input + 1;
    };
    const auto write = [&, fail](int view, int output) -> Expected<void> {
      const std::lock_guard lock(mutex_);
      EXPECT_NE(std::this_thread::get_id(), main_);
      EXPECT_EQ(output, 10 * view + 1);
      if (view == bad_write) return fail("write");
      written_.push_back(view);
      return {};
    };
    const auto tell = [&](int view, int output) {
      EXPECT_EQ(std::this_thread::get_id(), main_);
      EXPECT_EQ(output, 10 * view + 1);
      told_.push_back(view);
    };
    return for_each_view(run_, views_, {"reading", "working", "writing"}, read, work, write, in_flight_, tell);
  }

  std::string failure_of(const Expected<void>& done) { return done ? "none" : done.error().message; }

  TemporaryFolder folder_;
  Scene scene_;
  RunOptions options_;
  CpuBackend cpu_;
  Workspace workspace_ = Workspace::open(folder_.path()).value();
  StoppingProgress progress_;
  quorum::Run run_{scene_, options_, cpu_, workspace_, progress_};
  std::vector<int> views_ = {0, 2, 3, 4};
  std::vector<int> worked_;
  std::vector<int> told_;
  std::vector<int> written_;
  std::mutex mutex_;  // of what is worked on and written
  ViewsInFlight in_flight_;
  std::thread::id main_ = std::this_thread::get_id();
};

TEST_F(ViewLoop, EveryViewIsReadWorkedOnAndWrittenInOrder) {
  EXPECT_EQ(failure_of(loop()), "none");
  EXPECT_EQ(worked_, views_);
  EXPECT_EQ(told_, views_);
  EXPECT_EQ(written_, views_);
  EXPECT_EQ(progress_.steps, 4);
  ASSERT_EQ(run_.report.stages.size(), 3U);
  EXPECT_EQ(run_.report.stages[0].name, "working");
}

TEST_F(ViewLoop, NoViewIsNoWork) {
  views_.clear();
  EXPECT_EQ(failure_of(loop()), "none");
  EXPECT_TRUE(worked_.empty());
}

TEST_F(ViewLoop, TheFirstFailureEndsItAndWhatWasDoneIsWritten) {
  EXPECT_EQ(failure_of(loop(3)), "read");
  EXPECT_EQ(written_, (std::vector<int>{0, 2}));
  worked_.clear();
  written_.clear();
  EXPECT_EQ(failure_of(loop(-1, 3)), "view3: work");
  EXPECT_EQ(written_, (std::vector<int>{0, 2}));
  worked_.clear();
  EXPECT_EQ(failure_of(loop(-1, -1, 2)), "write");
  EXPECT_LE(worked_.size(), 3U);
}

TEST_F(ViewLoop, AStopEndsItBeforeTheNextView) {
  progress_.stop_after = 2;
  const auto stopped = loop();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::kStopped);
  EXPECT_EQ(written_, (std::vector<int>{0, 2, 3})) << "two that were told, and the one that was being written";
}

TEST_F(ViewLoop, SeveralInFlightGiveTheSame) {
  in_flight_.count = 3;
  EXPECT_EQ(failure_of(loop()), "none");
  EXPECT_EQ(worked_, views_);
  std::ranges::sort(written_);
  EXPECT_EQ(written_, views_);
  EXPECT_EQ(progress_.steps, 4);
}

TEST_F(ViewLoop, SeveralWorkersGiveTheSameInOrder) {
  in_flight_ = {.count = 2, .workers = 3};
  EXPECT_EQ(failure_of(loop()), "none");
  std::ranges::sort(worked_);
  EXPECT_EQ(worked_, views_);
  EXPECT_EQ(told_, views_);
  std::ranges::sort(written_);
  EXPECT_EQ(written_, views_);
  EXPECT_EQ(progress_.steps, 4);
  ASSERT_EQ(run_.report.stages.size(), 3U);
  EXPECT_EQ(run_.report.stages[1].name, "working");
  EXPECT_GT(run_.report.stages[1].wall_seconds, 0.08) << "of all workers";
}

TEST_F(ViewLoop, WithSeveralWorkersViewsBeforeAFailureAreWritten) {
  in_flight_ = {.count = 2, .workers = 3};
  EXPECT_EQ(failure_of(loop(-1, 3)), "view3: work");
  EXPECT_EQ(told_, (std::vector<int>{0, 2}));
  std::ranges::sort(written_);
  EXPECT_EQ(written_, (std::vector<int>{0, 2}));
  told_.clear();
  EXPECT_EQ(failure_of(loop(4)), "read");
  progress_.stop_after = 0;
  EXPECT_FALSE(loop());
}

TEST_F(ViewLoop, AStopWritesWhatWorkersHaveBegun) {
  in_flight_ = {.count = 1, .workers = 2};
  views_ = {0, 1, 2, 3, 4};
  progress_.stop_after = 1;
  const auto stopped = loop();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::kStopped);
  std::ranges::sort(worked_);
  EXPECT_EQ(told_, worked_);
  EXPECT_EQ(written_, told_);
  EXPECT_EQ(told_, (std::vector<int>{0, 1, 2, 3}));
}

TEST_F(ViewLoop, AViewIsToldWhenItIsWritten) {
  in_flight_.count = 2;
  EXPECT_EQ(failure_of(loop(-1, 4)), "view4: work");
  EXPECT_LE(progress_.steps, static_cast<int>(written_.size()));
  EXPECT_EQ(written_.size(), 3U) << "what was done is written to its end";
  progress_.steps = 0;
  EXPECT_EQ(failure_of(loop(-1, -1, 2)), "write");
  EXPECT_LE(progress_.steps, 1);
}

}  // namespace
}  // namespace quorum
