#include "host/view_workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "tests/support/vulkan_test.h"

namespace quorum {
namespace {

class ViewWorkersTest : public VulkanTest {
 protected:
  static Device staged() { return Device::open(device().info(), {.force_staging = true}).value(); }
};

/// Counts those who work at the same time.
struct AtOnce {
  std::atomic<int> now = 0;
  std::atomic<int> most = 0;

  /// Works until so many have worked at once, on however slow a machine.
  void work(int wanted) {
    const int count = ++now;
    for (int before = most; before < count && !most.compare_exchange_weak(before, count);) {
    }
    for (int wait = 0; most < wanted && wait < 20'000; ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --now;
  }
};

TEST_F(ViewWorkersTest, NoMoreWorkAtOnceThanThereAreWorkers) {
  ViewWorkers workers(staged(), {});
  AtOnce at_once;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      const auto done = workers.with([&](ViewWorker&) -> Expected<int> {
        at_once.work(static_cast<int>(workers.count()));
        return 1;
      });
      EXPECT_TRUE(done);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(at_once.most, static_cast<int>(workers.count()));
  EXPECT_EQ(ViewWorkers(device(), {}).count(), device().maps_buffers() ? 1U : 3U);
}

TEST_F(ViewWorkersTest, WhereMemoryDoesNotSufficeEachIsTriedOnceMoreAlone) {
  ViewWorkers workers(staged(), {});
  AtOnce first;
  AtOnce again;
  std::atomic<int> succeeded = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i)
    threads.emplace_back([&] {
      int calls = 0;
      const auto done = workers.with([&](ViewWorker&) -> Expected<int> {
        if (++calls == 1) {
          first.work(2);
          return failure(ErrorKind::kMemory, "full");
        }
        EXPECT_EQ(first.now, 0);
        again.work(1);
        return calls;
      });
      succeeded += done && *done == 2 ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(succeeded, 6);
  EXPECT_GT(first.most, 1);
  EXPECT_EQ(again.most, 1);
  const auto never = workers.with([](ViewWorker&) -> Expected<int> { return failure(ErrorKind::kMemory, "full"); });
  EXPECT_FALSE(never);
}

TEST_F(ViewWorkersTest, AnExceptionGivesTheWorkerBack) {
  ViewWorkers workers(device(), {});
  const auto fail = [](ViewWorker&) -> Expected<int> { throw std::bad_alloc(); };
  for (int i = 0; i < 4; ++i) EXPECT_THROW((void)workers.with(fail), std::bad_alloc);
}

}  // namespace
}  // namespace quorum
