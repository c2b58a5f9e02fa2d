// What the pipeline asks of a device. CpuBackend and VulkanBackend give the same bytes.
#pragma once

#include <string>
#include <vector>

#include "engine/camera/camera.h"
#include "engine/core/error.h"
#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"
#include "engine/image/padded_image.h"
#include "engine/pipeline/device_work.h"
#include "engine/volume/carve_blocks.h"
#include "engine/volume/confirm_depths.h"
#include "engine/volume/fusion_options.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {

/// One view as the volume takes it.
struct FusionView {
  const DepthMap& map;
  const PaddedImage& image;
  const Camera& camera;
  const Grid<std::uint32_t>* normals = nullptr;  ///< of its pixels, as pack_normals gives them; null: none are known
};

/// Time that a device spent on one kernel or stage: of a GPU by its timestamps, of the CPU the sum over its threads.
struct StageTime {
  std::string name;
  double seconds = 0.0;
};

/// What the sweeps of a run asked for (windows: pixel · depth · neighbor) and did (samples of neighbors, interpolated).
/// Depends on the scene, the options and the tiles alone.
struct SweepCounts {
  std::uint64_t sweep_windows = 0;  ///< first pass
  std::uint64_t sweep_samples = 0;
  std::uint64_t refine_windows = 0;  ///< second pass, or planes that were tried
  std::uint64_t refine_samples = 0;
};

/// What a device can do at most in the seconds that kernel_times counts; 0 = unknown.
struct DeviceRates {
  double operations_per_second = 0.0;  ///< 32-bit multiplications and additions
  double bytes_per_second = 0.0;       ///< read and written
};

/// The stages of a run on one device. One call at a time, but sweep_depth and confirm_depths may be called for as many
/// views at once as views_at_once says. Failures are kDevice or kMemory.
class Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend() = default;

  /// What does the work, in words: "CPU, 2 threads, AVX-512" or a device with its driver.
  [[nodiscard]] virtual std::string description() const = 0;

  /// Views that are worth working on at the same time, so that the device does not wait for the host.
  [[nodiscard]] virtual std::size_t views_at_once() const { return 1; }

  /// Depth, correlation and confidence of one reference view (the paper, 2.1).
  virtual Expected<DepthMap> sweep_depth(const SweepTask& task) = 0;

  /// The certainty of a view's depths, from other views' depth maps.
  virtual Expected<Grid<float>> confirm_depths(const ConfirmTask& task) = 0;

  // A volume (the paper, 2.2): begin it, collect the blocks of every view, allocate them all, integrate every view into
  // its blocks, read them. Or, slab by slab: allocate some, integrate, read, and then the next. Views may come in any
  // order: sums are exact.

  /// Starts a volume and forgets the last.
  virtual Expected<void> begin_volume(const VoxelGrid& grid, const FusionOptions& options) = 0;
  /// Indices of the blocks near the view's range surface, ascending.
  virtual Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view) = 0;
  /// Stores these blocks (ascending), all voxels unseen.
  virtual Expected<void> allocate_blocks(std::vector<std::uint32_t> indices) = 0;
  /// Adds a view's range surface to the blocks that collect_blocks named for it.
  virtual Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) = 0;
  /// The stored blocks. The device holds none after that.
  virtual Expected<BlockPool> read_blocks() = 0;

  /// Marks the voxels of the grid that the view looks through, in a volume whose holes are to be filled
  /// (FusionOptions::fill_holes). The view's depth is kBackgroundDepth where nothing is; it needs no image.
  virtual Expected<void> carve_blocks(const FusionView& view) = 0;
  /// What was marked, of all blocks of the grid. The device holds nothing of it after that.
  virtual Expected<std::vector<BlockBits>> read_empty() = 0;

  /// Most blocks that fit into this much memory of the host, and into the device's; those read back included.
  [[nodiscard]] virtual std::size_t max_blocks(std::uint64_t host_bytes) const = 0;
  /// Memory of the host that the work on a view takes beside its inputs, bytes. neighbors: of a view that is swept; 0
  /// for one that is merged.
  [[nodiscard]] virtual std::uint64_t view_bytes(std::uint64_t pixels, int neighbors) const = 0;

  /// Makes the device anew after a failure (kDevice), as when the driver has lost it; the volume is gone. Fails if that
  /// can't be done; the backend is of no more use then.
  virtual Expected<void> renew() { return failure(ErrorKind::kDevice, "this device can't be made anew"); }

  /// Device seconds per kernel so far.
  [[nodiscard]] virtual std::vector<StageTime> kernel_times() const = 0;
  /// True if these are CPU seconds of this process.
  [[nodiscard]] virtual bool runs_on_host() const { return false; }
  /// Measures what the device can do at most; may take a second, and hundreds of MiB.
  virtual Expected<DeviceRates> measure_rates() { return DeviceRates{}; }
  /// Counted work of the sweeps so far; all 0 on a device that does not count it.
  [[nodiscard]] virtual SweepCounts sweep_counts() const { return {}; }
  /// So far.
  [[nodiscard]] virtual DeviceWork device_work() const { return {}; }
};

}  // namespace quorum
