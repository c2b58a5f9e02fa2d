// Depth maps on a Vulkan device: sweep_depth and vote_depth over all planes, then refine_depth and vote_depth around
// each pixel's best one.
#pragma once

#include <optional>

#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"
#include "host/batch_size.h"
#include "host/buffer.h"
#include "host/commands.h"
#include "host/kernel.h"

namespace quorum {

class DepthStage {
 public:
  /// Fails (kDevice, kMemory) if the device does.
  static Expected<DepthStage> create(const Device& device, Commands& commands);

  /// The depth map of one view. Fails (kDevice, kMemory) if the device does.
  Expected<DepthMap> run(const SweepTask& task);

 private:
  /// The kernels for one window size and model.
  struct Kernels {
    int window;
    WindowModel model;
    Kernel sweep_depth;
    Kernel refine_depth;
  };
  /// Device copies of a task's inputs, and the room for what the kernels pass on.
  struct Inputs {
    Buffer reference;
    std::vector<Buffer> neighbors;
    Buffer planes;
    Buffer ncc;
  };
  enum class Pass { kSweep, kRefine };

  DepthStage(const Device& device, Commands& commands, Kernel vote_depth);
  Expected<void> prepare_kernels(const SweepOptions& options);
  Expected<Inputs> upload(const SweepTask& task) const;
  Expected<Grid<PixelVote>> run_pass(const SweepTask& task, const Inputs& inputs, const Grid<PlaneRange>& ranges,
                                     Pass pass);

  const Device* device_;
  Commands* commands_;
  Kernel vote_depth_;
  std::optional<Kernels> kernels_;
  BatchSize sweep_batch_;  // windows per submission
  BatchSize refine_batch_;
};

}  // namespace quorum
