// A thread beside the one that computes: it reads what comes next, or writes what is done.
#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <queue>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/pipeline/run_report.h"

namespace quorum {

/// Runs jobs one after the other. What oneTBB would spread over the cores within a job stays on this thread, so that
/// its time can be told from that of the computation. Jobs that have begun or wait are done before the object goes;
/// what they refer to must live longer. An exception reaches whoever asks the future.
class BackgroundThread {
 public:
  BackgroundThread();
  ~BackgroundThread();
  BackgroundThread(const BackgroundThread&) = delete;
  BackgroundThread& operator=(const BackgroundThread&) = delete;

  /// Adds a job; the future has its result.
  template <typename Work>
  std::future<std::invoke_result_t<Work>> run(Work work) {
    std::packaged_task<std::invoke_result_t<Work>()> task(std::move(work));
    auto result = task.get_future();
    push(std::packaged_task<void()>([task = std::move(task)]() mutable { task(); }));
    return result;
  }

  /// Time that the jobs took on this thread, as a stage of this name. Waits until they are done.
  [[nodiscard]] StageReport time(std::string name) const;

 private:
  void push(std::packaged_task<void()> job);
  void work();

  mutable std::mutex mutex_;  ///< guards what follows
  mutable std::condition_variable changed_;
  std::queue<std::packaged_task<void()>> jobs_;
  StageReport time_;
  bool busy_ = false;
  bool ending_ = false;
  std::thread thread_;
};

/// Some of them: jobs go to one after the other, and run at the same time.
class BackgroundThreads {
 public:
  /// count: 0 if there are no jobs.
  explicit BackgroundThreads(std::size_t count);

  /// As BackgroundThread::run.
  template <typename Work>
  std::future<std::invoke_result_t<Work>> run(Work work) {
    return threads_[next_++ % threads_.size()]->run(std::move(work));
  }
  /// As BackgroundThread::time, of all of them.
  [[nodiscard]] StageReport time(const std::string& name) const;

 private:
  std::vector<std::unique_ptr<BackgroundThread>> threads_;
  std::size_t next_ = 0;
};

}  // namespace quorum
