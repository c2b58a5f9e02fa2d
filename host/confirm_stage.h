// Geometric confirmation on a Vulkan device: confirm_depths, one other view at a time.
#pragma once

#include "engine/volume/confirm_depths.h"
#include "host/commands.h"
#include "host/kernel.h"

namespace quorum {

class ConfirmStage {
 public:
  /// Fails (kDevice, kMemory) if the device does.
  static Expected<ConfirmStage> create(const Device& device, Commands& commands);

  /// The certainty of a view's depths. Fails (kDevice, kMemory) if the device does.
  Expected<Grid<float>> run(const ConfirmTask& task);

 private:
  ConfirmStage(const Device& device, Commands& commands, Kernel confirm_depths)
      : device_(&device), commands_(&commands), confirm_depths_(std::move(confirm_depths)) {}

  const Device* device_;
  Commands* commands_;
  Kernel confirm_depths_;
};

}  // namespace quorum
