// Geometric confirmation on a Vulkan device: confirm_depths, one other view at a time.
#pragma once

#include "engine/volume/confirm_depths.h"
#include "host/commands.h"
#include "host/kernel.h"
#include "host/residents.h"

namespace quorum {

class ConfirmStage {
 public:
  /// The commands keep a failure to make kernels.
  explicit ConfirmStage(Commands& commands);

  /// The certainty of a view's depths. Fails (kDevice, kMemory) if the device does.
  Expected<Grid<float>> run(const ConfirmTask& task);

  /// Leaves the device's memory to other stages.
  void forget() { views_.clear(); }

 private:
  /// Depths and certainties of a view; depths in place of certainties that it does not have.
  std::vector<Buffer> upload(const ViewDepths& view) const;

  Commands* commands_;
  Kernel confirm_depths_;
  Residents<ViewDepths> views_;
};

}  // namespace quorum
