// Tilted planes on software Vulkan: refine_planes_lanes, a round at a time. The form for GPUs: host/plane_stage.h.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/depth/plane_moves.h"
#include "engine/depth/sweep_task.h"
#include "host/buffer.h"
#include "host/commands.h"
#include "host/window_kernels.h"

namespace quorum {

class PlaneLanesStage {
 public:
  explicit PlaneLanesStage(Commands& commands) : commands_(&commands), kernels_(commands, "refine_planes_lanes") {}

  /// True if the device takes the images of the task as texels.
  [[nodiscard]] bool fits(const SweepTask& task) const;

  /// The best plane per pixel, from the votes of the sweep's first pass. Fails (kDevice, kMemory) if the device does.
  Expected<Grid<PixelPlane>> run(const SweepTask& task, const Grid<PixelVote>& first_pass);

 private:
  /// Device copies of a task's inputs, and the planes: those of the last round, and those of this one.
  struct Buffers {
    Buffer neighbors;
    Buffer pixels;
    Buffer quads;
    Buffer last;
    Buffer planes;
    Buffer correlations;
  };

  [[nodiscard]] Buffer upload_images(const SweepTask& task) const;
  [[nodiscard]] Buffers upload(const SweepTask& task, const Grid<PixelVote>& first_pass) const;
  Expected<void> run_round(const SweepTask& task, Buffers& buffers, const std::vector<PlaneMove>& moves, bool is_first);

  Commands* commands_;
  WindowKernels kernels_;
};

}  // namespace quorum
