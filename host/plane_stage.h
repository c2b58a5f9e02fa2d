// Tilted planes on a GPU: first_planes and support_windows, then refine_planes, a round of moves at a time. The form
// for software Vulkan: host/plane_lanes_stage.h.
#pragma once

#include <map>
#include <vector>

#include "engine/depth/plane_moves.h"
#include "engine/depth/sweep_task.h"
#include "host/batch_size.h"
#include "host/buffer.h"
#include "host/commands.h"
#include "host/kernel.h"
#include "host/pacer.h"
#include "host/window_kernels.h"

namespace quorum {

/// What the sweep left on the device.
struct SweptView {
  Buffer reference;               ///< pixels of its padded image
  std::vector<Buffer> neighbors;  ///< likewise
  Buffer ranges;                  ///< PlaneRange per pixel, those of the task
  Buffer votes;                   ///< PixelVote per pixel, of the first pass
};

class PlaneStage {
 public:
  /// The commands keep a failure to make kernels.
  explicit PlaneStage(Commands& commands);

  /// True if kernels can see all that they need of a view.
  [[nodiscard]] bool fits(const SweepTask& task) const;

  /// The best plane per pixel, after the sweep's first pass. Fails (kDevice, kMemory) if the device does.
  Expected<Grid<PixelPlane>> run(const SweepTask& task, const SweptView& swept);

 private:
  /// A task's inputs, and the planes of the last round and of this one.
  struct Buffers {
    Buffer images;
    Buffer neighbors;
    Buffer windows;
    Buffer ranges;
    Buffer last;
    Buffer best;
  };

  [[nodiscard]] Buffers prepare(const SweepTask& task, const SweptView& swept);
  Expected<void> run_round(const SweepTask& task, Buffers& buffers, const std::vector<PlaneMove>& moves, bool is_first,
                           Pacer& pacer);

  Commands* commands_;
  Kernel first_planes_;
  WindowKernels support_windows_;
  WindowKernels refine_planes_;
  std::map<int, BatchSize> batch_sizes_;  ///< windows per submission, by their side
};

}  // namespace quorum
