#include "host/view_workers.h"

namespace quorum {

Expected<ViewWorker*> ViewWorkers::take() {
  std::unique_lock lock(mutex_);
  given_.wait(lock, [this] { return all_.size() - idle_.size() < most_; });
  if (idle_.empty()) {
    QUORUM_ASSIGN(auto commands, Commands::create(device_));
    auto made = std::make_unique<ViewWorker>(std::move(commands), form_);
    QUORUM_TRY(made->commands.submit());  // the failures of the stages' kernels
    all_.push_back(std::move(made));
    return all_.back().get();
  }
  ViewWorker* const worker = idle_.back();
  idle_.pop_back();
  return worker;
}

void ViewWorkers::give(ViewWorker* worker) {
  {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(worker);
  }
  given_.notify_all();
}

void ViewWorkers::begin_waiting() {
  {
    const std::scoped_lock lock(mutex_);
    most_ = 1;
    ++waiting_;
  }
  given_.notify_all();
}

void ViewWorkers::wait_until_alone() {
  std::unique_lock lock(mutex_);
  given_.wait(lock, [this] { return idle_.size() + waiting_ >= all_.size(); });
  for (const auto& worker : all_) {
    worker->depth.forget();
    worker->confirm.forget();
  }
}

void ViewWorkers::stop_waiting() {
  const std::scoped_lock lock(mutex_);
  --waiting_;
}

void ViewWorkers::forget() {
  const std::scoped_lock lock(mutex_);
  for (const auto& worker : all_)
    lost_timings_.insert(lost_timings_.end(), worker->commands.timings().begin(), worker->commands.timings().end());
  idle_.clear();
  all_.clear();
}

std::vector<RegionTiming> ViewWorkers::timings() const {
  const std::scoped_lock lock(mutex_);
  std::vector<RegionTiming> all = lost_timings_;
  for (const auto& worker : all_)
    all.insert(all.end(), worker->commands.timings().begin(), worker->commands.timings().end());
  return all;
}

}  // namespace quorum
