// What works on views on a device, each with commands and buffers of its own, so that several views are under way:
// while the device computes one, the host prepares the next.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "host/commands.h"
#include "host/confirm_stage.h"
#include "host/depth_stage.h"

namespace quorum {

/// Commands, and the stages that take one view.
struct ViewWorker {
  ViewWorker(Commands made, std::optional<SweepForm> form)
      : commands(std::move(made)), depth(commands, form), confirm(commands) {}

  Commands commands;
  DepthStage depth;
  ConfirmStage confirm;
};

class ViewWorkers {
 public:
  ViewWorkers(const Device& device, std::optional<SweepForm> form) : device_(device), form_(form), most_(count()) {}

  /// One where the device reads the host's memory, and several where values go there and back.
  [[nodiscard]] std::size_t count() const { return device_.maps_buffers() ? 1 : 3; }

  /// use(worker), with a worker that nobody else has; waits while all are taken. Where memory does not suffice it is
  /// tried once more when nobody else works, and from then on one works at a time. Fails (kDevice, kMemory) if another
  /// worker can't be made, and as use does.
  template <typename Use>
  auto with(const Use& use) -> decltype(use(std::declval<ViewWorker&>())) {
    QUORUM_ASSIGN(ViewWorker* const worker, take());
    const std::unique_ptr<ViewWorker, std::function<void(ViewWorker*)>> giver(worker,
                                                                              [this](ViewWorker* w) { give(w); });
    auto result = use(*worker);
    if (result || result.error().kind != ErrorKind::kMemory || count() == 1) return result;
    begin_waiting();
    const std::scoped_lock alone(alone_mutex_);
    wait_until_alone();
    result = use(*worker);
    stop_waiting();
    return result;
  }

  /// Leaves the device's memory to other stages; nobody has a worker then.
  void forget();

  /// Device seconds per kernel of all of them; nobody has a worker then.
  [[nodiscard]] std::vector<RegionTiming> timings() const;

 private:
  Expected<ViewWorker*> take();
  void give(ViewWorker* worker);
  /// One works at a time from now on, and this one waits for it.
  void begin_waiting();
  /// Waits until the other workers are idle or wait, too, and takes from all what they keep on the device.
  void wait_until_alone();
  void stop_waiting();

  Device device_;
  std::optional<SweepForm> form_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable given_;
  std::vector<std::unique_ptr<ViewWorker>> all_;
  std::vector<ViewWorker*> idle_;
  std::size_t most_;                        ///< that work at once
  std::size_t waiting_ = 0;                 ///< to be alone
  std::vector<RegionTiming> lost_timings_;  ///< of workers that are gone

  std::mutex alone_mutex_;  ///< held by the one that works alone
};

}  // namespace quorum
