// Geometric confirmation on a Vulkan device: confirm_depths, one other view at a time.
#pragma once

#include "engine/volume/confirm_depths.h"
#include "host/commands.h"
#include "host/kernel.h"

namespace quorum {

class ConfirmStage {
 public:
  /// The commands keep a failure to make kernels.
  explicit ConfirmStage(Commands& commands)
      : commands_(&commands), confirm_depths_(commands.kernel("confirm_depths")) {}

  /// The certainty of a view's depths. Fails (kDevice, kMemory) if the device does.
  Expected<Grid<float>> run(const ConfirmTask& task);

 private:
  Commands* commands_;
  Kernel confirm_depths_;
};

}  // namespace quorum
