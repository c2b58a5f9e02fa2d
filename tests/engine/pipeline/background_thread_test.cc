#include "engine/pipeline/background_thread.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include <mutex>
#include <set>
#include <stdexcept>
#include <vector>

#include "engine/core/clock.h"

namespace quorum {
namespace {

/// Takes at least this much CPU time of the calling thread.
void work_for(double seconds) {
  const double start = thread_cpu_seconds();
  while (thread_cpu_seconds() - start < seconds) continue;
}

TEST(BackgroundThread, RunsJobsInOrderAndGivesTheirResults) {
  std::vector<int> order;
  std::vector<std::future<int>> results;
  {
    BackgroundThread thread;
    for (int job = 0; job < 100; ++job)
      results.push_back(thread.run([&order, job] {
        order.push_back(job);
        return job * job;
      }));
  }
  ASSERT_EQ(order.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(order));
  for (int job = 0; job < 100; ++job) EXPECT_EQ(results[static_cast<std::size_t>(job)].get(), job * job);
}

TEST(BackgroundThread, AnExceptionReachesTheOneWhoAsks) {
  BackgroundThread thread;
  auto result = thread.run([]() -> int { throw std::bad_alloc(); });
  EXPECT_THROW(result.get(), std::bad_alloc);
  EXPECT_EQ(thread.run([] { return 7; }).get(), 7);
}

TEST(BackgroundThread, ParallelLoopsStayOnIt) {
  BackgroundThread thread;
  std::mutex mutex;
  std::set<std::thread::id> threads;
  thread
      .run([&] {
        tbb::parallel_for(0, 64, [&](int) {
          work_for(0.0005);
          const std::lock_guard lock(mutex);
          threads.insert(std::this_thread::get_id());
        });
      })
      .get();
  EXPECT_EQ(threads.size(), 1U);
  EXPECT_FALSE(threads.contains(std::this_thread::get_id()));
}

TEST(BackgroundThread, ItsTimeIsTakenOffTheForeground) {
  const double foreground = foreground_cpu_seconds();
  const double process = process_cpu_seconds();
  {
    BackgroundThread thread;
    auto done = thread.run([] { work_for(0.2); });
    work_for(0.05);
    done.get();
    EXPECT_GE(process_cpu_seconds() - process, 0.25);
    EXPECT_LT(foreground_cpu_seconds() - foreground, 0.15);
    const StageReport time = thread.time("reading");
    EXPECT_EQ(time.name, "reading");
    EXPECT_GE(time.cpu_seconds, 0.2);
    EXPECT_GE(time.wall_seconds, 0.2);
  }
  EXPECT_LT(foreground_cpu_seconds() - foreground, 0.15);
}

}  // namespace
}  // namespace quorum
