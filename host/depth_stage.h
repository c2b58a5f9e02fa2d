// Depth maps on a Vulkan device: sweep_depth and vote_depth over all planes, then again over the planes around each
// pixel's best one (between the two passes only the planes differ), or tilted planes instead (host/plane_stage.h).
#pragma once

#include <list>
#include <optional>
#include <span>

#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"
#include "host/batch_size.h"
#include "host/buffer.h"
#include "host/commands.h"
#include "host/kernel.h"
#include "host/plane_lanes_stage.h"
#include "host/plane_stage.h"
#include "host/sweep_batch.h"

namespace quorum {

/// The kernel that sweeps. All give the same bytes.
enum class SweepForm {
  kGroups,  ///< sweep_depth: a work group per block, samples in shared memory; for GPUs
  kLanes,   ///< sweep_depth_lanes: an invocation per block, samples as texels; for software Vulkan
};

class DepthStage {
 public:
  /// form: empty = the one for this kind of device. Fails (kDevice, kMemory) if the device does.
  static Expected<DepthStage> create(const Device& device, Commands& commands, std::optional<SweepForm> form = {});

  /// The depth map of one view. Fails (kDevice, kMemory) if the device does.
  Expected<DepthMap> run(const SweepTask& task);

 private:
  /// The kernel of a pass, for blocks of one size.
  struct Pass {
    BlockSize block;
    Kernel kernel;
  };
  /// The kernels for one window size and model.
  struct Sweep {
    SweepForm form;
    int window;
    WindowModel model;
    Pass first;
    Pass second;
  };
  /// Device copies of a task's inputs, and the room for what the kernels pass on.
  struct Inputs {
    Buffer reference;
    Buffer windows;
    std::vector<Buffer> neighbors;
    Buffer ncc;
  };

  /// Rows of the view, as many as kernels see the votes of.
  struct Band {
    int height;
    Buffer ranges;
    Buffer votes;
  };

  DepthStage(const Device& device, Commands& commands, SweepForm form, Kernel vote_depth, PlaneStage planes);
  [[nodiscard]] SweepForm form_of(const SweepTask& task) const;
  Expected<void> prepare_kernels(const SweepTask& task);
  [[nodiscard]] Expected<Pass> make_pass(SweepForm form, const SweepOptions& options, BlockSize block) const;
  Expected<Inputs> upload(const SweepTask& task) const;
  Expected<Grid<PixelVote>> sweep(const SweepTask& task);
  Expected<Grid<PixelVote>> run_pass(const SweepTask& task, const Inputs& inputs, const Grid<PlaneRange>& ranges,
                                     const Pass& pass, int stride);
  /// votes: of the band, on entry and after it.
  Expected<void> run_band(const SweepTask& task, const Inputs& inputs, const Grid<PlaneRange>& ranges, const Pass& pass,
                          int stride, int row_begin, std::span<PixelVote> votes);
  Expected<void> run_batch(const SweepTask& task, const Inputs& inputs, const Pass& pass, const SweepBatch& batch,
                           const Band& band);

  const Device* device_;
  Commands* commands_;
  SweepForm form_;
  Kernel vote_depth_;
  PlaneStage planes_;
  PlaneLanesStage planes_in_lanes_;
  std::list<Sweep> sweeps_;       // that were made so far
  const Sweep* sweep_ = nullptr;  // of the task
  BatchSize batch_size_;          // windows per submission
};

}  // namespace quorum
