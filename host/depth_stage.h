// Depth maps on a Vulkan device: sweep_depth and vote_depth over all planes, then again over the planes around each
// pixel's best one (between the two passes only the planes differ), or tilted planes instead (host/plane_stage.h).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>

#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"
#include "host/batch_size.h"
#include "host/buffer.h"
#include "host/commands.h"
#include "host/kernel.h"
#include "host/plane_lanes_stage.h"
#include "host/plane_stage.h"
#include "host/residents.h"
#include "host/sweep_batch.h"
#include "host/window_kernels.h"

namespace quorum {

/// The kernel that sweeps. All give the same bytes.
enum class SweepForm {
  kGroups,  ///< sweep_depth: a work group per block, samples in shared memory; for GPUs
  kLanes,   ///< sweep_depth_lanes: an invocation per block, samples as texels; for software Vulkan
};

class DepthStage {
 public:
  /// form: empty = the one for this kind of device. The commands keep a failure to make kernels.
  explicit DepthStage(Commands& commands, std::optional<SweepForm> form = {});

  /// The depth map of one view. Fails (kDevice, kMemory) if the device does.
  Expected<DepthMap> run(const SweepTask& task);

  /// Leaves the device's memory to other stages.
  void forget() { images_.clear(); }

 private:
  /// The kernel of a pass, for blocks of one size.
  struct Pass {
    BlockSize block;
    Kernel kernel;
  };
  /// The kernels for one form, window size and model.
  struct Sweep {
    SweepForm form;
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

  [[nodiscard]] SweepForm form_of(const SweepTask& task) const;
  void prepare_kernels(const SweepTask& task);
  [[nodiscard]] Pass make_pass(SweepForm form, const SweepOptions& options, BlockSize block) const;
  Buffer pixels_of(const std::shared_ptr<const PaddedImage>& image) { return images_.of(image).front(); }
  [[nodiscard]] Inputs make_inputs(const SweepTask& task);
  Expected<DepthMap> sweep(const SweepTask& task);
  /// Two passes on planes that face the camera.
  Expected<DepthMap> sweep_twice(const SweepTask& task, const Inputs& inputs);
  /// One pass, and tilted planes after it.
  Expected<DepthMap> sweep_slanted(const SweepTask& task, Inputs inputs);
  Expected<Grid<PixelVote>> run_pass(const SweepTask& task, const Inputs& inputs, const Grid<PlaneRange>& ranges,
                                     const Pass& pass, int stride);
  [[nodiscard]] Band make_band(const Grid<PlaneRange>& ranges) const;
  /// Records and submits all but the last batches of a band, which begins with this row of the view.
  Expected<void> run_band(const SweepTask& task, const Inputs& inputs, const Grid<PlaneRange>& ranges, const Pass& pass,
                          int stride, int row_begin, const Band& band, Pacer& pacer);
  void record_batch(const SweepTask& task, const Inputs& inputs, const Pass& pass, const SweepBatch& batch,
                    const Band& band);

  Commands* commands_;
  const DeviceInfo* info_;
  SweepForm form_;
  Kernel vote_depth_;
  WindowKernels reference_windows_;
  Residents<PaddedImage> images_;
  PlaneStage planes_;
  PlaneLanesStage planes_in_lanes_;
  std::map<std::tuple<SweepForm, int, WindowModel>, Sweep> sweeps_;  // that were made so far
  const Sweep* sweep_ = nullptr;                                     // of the task
  BatchSize batch_size_;                                             // windows per submission
};

}  // namespace quorum
