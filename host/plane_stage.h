// Tilted planes on a Vulkan device: refine_planes and score_planes in turn, a move at a time.
#pragma once

#include "engine/depth/plane_moves.h"
#include "engine/depth/sweep_task.h"
#include "host/buffer.h"
#include "host/commands.h"
#include "host/kernel.h"
#include "host/window_kernels.h"

namespace quorum {

class PlaneStage {
 public:
  /// Fails (kDevice, kMemory) if the device does.
  static Expected<PlaneStage> create(const Device& device, Commands& commands);

  /// The best plane per pixel, from the votes of the sweep's first pass. Fails (kDevice, kMemory) if the device does.
  Expected<Grid<PixelPlane>> run(const SweepTask& task, const Grid<PixelVote>& first_pass);

 private:
  /// Device copies of a task's inputs, and the planes.
  struct Buffers {
    Buffer reference;
    Buffer windows;
    std::vector<Buffer> neighbors;
    Buffer ranges;
    Buffer last;
    Buffer best;
    Buffer trials;
  };

  PlaneStage(const Device& device, Commands& commands, Kernel refine_planes);
  [[nodiscard]] Expected<Buffers> upload(const SweepTask& task, const Grid<PixelVote>& first_pass) const;
  void score(const SweepTask& task, const Buffers& buffers);
  void refine(const SweepTask& task, const Buffers& buffers, const PlaneMove& move, int tried, bool ends_round);

  const Device* device_;
  Commands* commands_;
  Kernel refine_planes_;
  WindowKernels score_planes_;
};

}  // namespace quorum
