// What works on views on a device, each with commands and buffers of its own, so that several views are under way:
// while the device computes one, the host prepares the next.
#pragma once

#include <condition_variable>
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
  ViewWorkers(const Device& device, std::optional<SweepForm> form) : device_(device), form_(form) {}

  /// One where the device reads the host's memory, and several where values go there and back.
  [[nodiscard]] std::size_t count() const { return device_.maps_buffers() ? 1 : 3; }

  /// use(worker), with a worker that nobody else has; waits while all are taken. Fails (kDevice, kMemory) if another
  /// one can't be made, and as use does.
  template <typename Use>
  auto with(const Use& use) -> decltype(use(std::declval<ViewWorker&>())) {
    QUORUM_ASSIGN(ViewWorker* const worker, take());
    auto result = use(*worker);
    give(worker);
    return result;
  }

  /// Leaves the device's memory to other stages; nobody has a worker then.
  void forget();

  /// Device seconds per kernel of all of them; nobody has a worker then.
  [[nodiscard]] std::vector<RegionTiming> timings() const;

 private:
  Expected<ViewWorker*> take();
  void give(ViewWorker* worker);

  Device device_;
  std::optional<SweepForm> form_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable given_;
  std::vector<std::unique_ptr<ViewWorker>> all_;
  std::vector<ViewWorker*> idle_;
};

}  // namespace quorum
