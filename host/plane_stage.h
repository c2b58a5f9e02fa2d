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
  /// The commands keep a failure to make kernels.
  explicit PlaneStage(Commands& commands)
      : commands_(&commands),
        refine_planes_(commands.kernel("refine_planes")),
        score_planes_(commands, "score_planes") {}

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

  [[nodiscard]] Buffers upload(const SweepTask& task, const Grid<PixelVote>& first_pass) const;
  void score(const SweepTask& task, const Buffers& buffers);
  void refine(const SweepTask& task, const Buffers& buffers, const PlaneMove& move, int tried, bool ends_round);

  Commands* commands_;
  Kernel refine_planes_;
  WindowKernels score_planes_;
};

}  // namespace quorum
