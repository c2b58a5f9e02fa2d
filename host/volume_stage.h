// The volume on a Vulkan device: range_surface and weigh_surface of a view, collect_blocks, integrate or carve_blocks
// on what they give. The block pool, and the bits of empty voxels, are cut into buffers of which none exceeds what a
// kernel can see.
#pragma once

#include <vector>

#include "engine/pipeline/backend.h"
#include "host/buffer.h"
#include "host/commands.h"
#include "host/kernel.h"

namespace quorum {

class VolumeStage {
 public:
  /// Fails (kDevice, kMemory) if the device does.
  static Expected<VolumeStage> create(const Device& device, Commands& commands);

  /// As in Backend. Fail (kDevice, kMemory) if the device does.
  Expected<void> begin(const VoxelGrid& grid, const FusionOptions& options);
  Expected<std::vector<std::uint32_t>> collect_blocks(const FusionView& view);
  Expected<void> allocate_blocks(std::vector<std::uint32_t> indices);
  Expected<void> integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks);
  Expected<BlockPool> read_blocks();
  Expected<void> carve_blocks(const FusionView& view);
  Expected<std::vector<BlockBits>> read_empty();

 private:
  struct Kernels {
    Kernel range_surface;
    Kernel weigh_surface;
    Kernel collect_blocks;
    Kernel integrate;
    Kernel carve_blocks;
  };
  /// A view's depth map and range surface on the device.
  struct Surface {
    Buffer depth;
    Buffer confidence;
    Buffer cells;
    Buffer weights;
  };

  VolumeStage(const Device& device, Commands& commands, Kernels kernels)
      : device_(&device), commands_(&commands), kernels_(std::move(kernels)) {}
  /// Uploads a view and records the kernels that make its surface.
  Expected<Surface> record_surface(const FusionView& view);

  const Device* device_;
  Commands* commands_;
  Kernels kernels_;
  VoxelGrid grid_;
  FusionOptions fusion_;
  std::vector<std::uint32_t> indices_;  // of the stored blocks
  std::vector<Buffer> pool_;            // blocks_per_buffer_ each
  std::size_t blocks_per_buffer_ = 0;
  std::vector<Buffer> empty_;  // of all blocks of the grid, empty_per_buffer_ each
  std::size_t empty_per_buffer_ = 0;
};

}  // namespace quorum
