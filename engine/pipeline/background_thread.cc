#include "engine/pipeline/background_thread.h"

#include <oneapi/tbb/task_arena.h>

#include "engine/core/clock.h"

namespace quorum {

BackgroundThread::BackgroundThread() : thread_([this] { work(); }) {}

BackgroundThread::~BackgroundThread() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

StageReport BackgroundThread::time(std::string name) const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.empty() && !busy_; });
  return {std::move(name), time_.wall_seconds, time_.cpu_seconds};
}

void BackgroundThread::push(std::packaged_task<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push(std::move(job));
  }
  changed_.notify_all();
}

void BackgroundThread::work() {
  const BackgroundClock clock;
  tbb::task_arena alone(1);
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    auto job = std::move(jobs_.front());
    jobs_.pop();
    busy_ = true;
    lock.unlock();
    const double wall_start = wall_seconds();
    const double cpu_start = thread_cpu_seconds();
    alone.execute([&] { job(); });
    job = {};  // what it held goes now
    lock.lock();
    time_.wall_seconds += wall_seconds() - wall_start;
    time_.cpu_seconds += thread_cpu_seconds() - cpu_start;
    busy_ = false;
    changed_.notify_all();
  }
}

BackgroundThreads::BackgroundThreads(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) threads_.push_back(std::make_unique<BackgroundThread>());
}

StageReport BackgroundThreads::time(const std::string& name) const {
  StageReport sum{name, 0.0, 0.0};
  for (const auto& thread : threads_) {
    const StageReport one = thread->time(name);
    sum.wall_seconds += one.wall_seconds;
    sum.cpu_seconds += one.cpu_seconds;
  }
  return sum;
}

}  // namespace quorum
