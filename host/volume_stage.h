// The volume on a Vulkan device: range_surface and weigh_surface of a view, collect_blocks, integrate or carve_blocks
// on what they give.
#pragma once

#include <vector>

#include "engine/pipeline/backend.h"
#include "host/block_buffers.h"
#include "host/commands.h"
#include "host/kernel.h"

namespace quorum {

class VolumeStage {
 public:
  /// The commands keep a failure to make kernels.
  explicit VolumeStage(Commands& commands);

  /// As in Backend. Fail (kDevice, kMemory) if the device does.
  Expected<void> begin(const VoxelGrid& grid, const FusionOptions& options);
  Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view);
  Expected<void> allocate_blocks(std::vector<std::uint32_t> indices);
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks);
  Expected<BlockPool> read_blocks();
  Expected<void> carve_blocks(const FusionView& view);
  Expected<std::vector<BlockBits>> read_empty();

 private:
  /// A view's depth map and range surface on the device.
  struct Surface {
    Buffer depth;
    Buffer confidence;
    Buffer normals;
    Buffer cells;
    Buffer weights;
  };

  /// Uploads a view and records the kernels that make its surface.
  Surface record_surface(const FusionView& view);

  Commands* commands_;
  Kernel range_surface_;
  Kernel weigh_surface_;
  Kernel collect_blocks_;
  Kernel integrate_;
  Kernel carve_blocks_;
  VoxelGrid grid_;
  FusionOptions fusion_;
  std::vector<std::uint32_t> indices_;  // of the stored blocks
  BlockBuffers pool_;                   // their voxels
  BlockBuffers empty_;                  // bits of empty voxels, of all blocks of the grid
};

}  // namespace quorum
