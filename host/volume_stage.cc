#include "host/volume_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

#include "engine/volume/collect_blocks.h"
#include "engine/volume/integrate.h"
#include "engine/volume/weigh_surface.h"
#include "host/kernel_table.h"

namespace quorum {
namespace {

constexpr std::size_t kBlockBytes = kBlockVoxels * sizeof(Voxel);
constexpr std::size_t kMaxDispatchBlocks =
    16384;  // 8 million voxels: some 10 ms, and within any maxComputeWorkGroupCount

}  // namespace

Expected<VolumeStage> VolumeStage::create(const Device& device, Commands& commands) {
  auto range_surface = Kernel::create(device, find_kernel("range_surface"));
  if (!range_surface) return std::unexpected(range_surface.error());
  auto weigh_surface = Kernel::create(device, find_kernel("weigh_surface"));
  if (!weigh_surface) return std::unexpected(weigh_surface.error());
  auto collect_blocks = Kernel::create(device, find_kernel("collect_blocks"));
  if (!collect_blocks) return std::unexpected(collect_blocks.error());
  auto integrate = Kernel::create(device, find_kernel("integrate"));
  if (!integrate) return std::unexpected(integrate.error());
  auto carve_blocks = Kernel::create(device, find_kernel("carve_blocks"));
  if (!carve_blocks) return std::unexpected(carve_blocks.error());
  return VolumeStage(device, commands,
                     Kernels{std::move(*range_surface), std::move(*weigh_surface), std::move(*collect_blocks),
                             std::move(*integrate), std::move(*carve_blocks)});
}

Expected<void> VolumeStage::begin(const VoxelGrid& grid, const FusionOptions& options) {
  grid_ = grid;
  fusion_ = options;
  indices_.clear();
  pool_.clear();
  empty_.clear();
  if (!options.fill_holes) return {};
  empty_per_buffer_ =
      std::min(device_->info().max_storage_buffer_range, device_->info().max_allocation) / sizeof(BlockBits);
  for (std::size_t first = 0; first < grid_.block_count(); first += empty_per_buffer_) {
    const std::size_t count = std::min(empty_per_buffer_, grid_.block_count() - first);
    auto buffer = Buffer::create(*device_, count * sizeof(BlockBits));
    if (!buffer) return std::unexpected(buffer.error().within("empty voxels"));
    if (auto filled = buffer->fill_zero(); !filled) return filled;
    empty_.push_back(std::move(*buffer));
  }
  return {};
}

Expected<VolumeStage::Surface> VolumeStage::record_surface(const FusionView& view) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  auto depth = Buffer::of(*device_, view.map.depth.values);
  if (!depth) return std::unexpected(depth.error());
  auto confidence = Buffer::of(*device_, view.map.confidence.values);
  if (!confidence) return std::unexpected(confidence.error());
  auto cells = Buffer::create(*device_, view.map.depth.values.size() * sizeof(std::uint32_t));
  if (!cells) return std::unexpected(cells.error());
  auto weights = Buffer::create(*device_, view.map.depth.values.size() * sizeof(std::uint32_t));
  if (!weights) return std::unexpected(weights.error());
  Surface surface{std::move(*depth), std::move(*confidence), std::move(*cells), std::move(*weights)};
  commands_->region("range_surface");
  commands_->dispatch(kernels_.range_surface, {width, height},
                      make_range_surface_params(view.camera, width, height, fusion_), {surface.depth, surface.cells});
  commands_->region("weigh_surface");
  commands_->dispatch(kernels_.weigh_surface, {width, height},
                      make_weigh_surface_params(view.camera, width, height, fusion_),
                      {surface.depth, surface.confidence, surface.cells, surface.weights});
  return surface;
}

Expected<std::vector<std::uint32_t>> VolumeStage::collect_blocks(const FusionView& view) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  auto surface = record_surface(view);
  if (!surface) return std::unexpected(surface.error());
  std::vector<std::uint32_t> bits((grid_.block_count() + 31) / 32);
  auto bit_buffer = Buffer::of(*device_, bits);
  if (!bit_buffer) return std::unexpected(bit_buffer.error());
  commands_->region("collect_blocks");
  commands_->dispatch(kernels_.collect_blocks, {width, height}, make_collect_params(view.camera, width, height, grid_),
                      {surface->depth, surface->weights, *bit_buffer});
  if (auto done = commands_->submit(); !done) return std::unexpected(done.error());
  if (auto read = bit_buffer->download(bits); !read) return std::unexpected(read.error());
  return block_indices(bits);
}

Expected<void> VolumeStage::allocate_blocks(std::vector<std::uint32_t> indices) {
  indices_ = std::move(indices);
  pool_.clear();
  blocks_per_buffer_ = std::max<std::size_t>(
      1, std::min(device_->info().max_storage_buffer_range, device_->info().max_allocation) / kBlockBytes);
  for (std::size_t first = 0; first < indices_.size(); first += blocks_per_buffer_) {
    const std::size_t count = std::min(blocks_per_buffer_, indices_.size() - first);
    auto buffer = Buffer::create(*device_, count * kBlockBytes);
    if (!buffer)
      return std::unexpected(buffer.error().within(
          fmt::format("volume of {} blocks, {} MiB", indices_.size(), indices_.size() * kBlockBytes >> 20)));
    if (auto filled = buffer->fill_zero(); !filled) return filled;
    pool_.push_back(std::move(*buffer));
  }
  return {};
}

Expected<void> VolumeStage::integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  const std::vector<BlockSlot> list = find_slots(blocks, indices_);
  if (list.empty()) return {};
  auto surface = record_surface(view);
  if (!surface) return std::unexpected(surface.error());
  auto image = Buffer::of(*device_, view.image.pixels);
  if (!image) return std::unexpected(image.error());
  auto list_buffer = Buffer::of(*device_, list);
  if (!list_buffer) return std::unexpected(list_buffer.error());

  IntegrateParams params = make_integrate_params(view.camera, width, height, grid_);
  commands_->region("integrate");
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t buffer = list[begin].slot / blocks_per_buffer_;
    const auto buffer_end =
        std::partition_point(list.begin() + static_cast<std::ptrdiff_t>(begin), list.end(),
                             [&](const BlockSlot& entry) { return entry.slot < (buffer + 1) * blocks_per_buffer_; });
    const std::size_t end = std::min(static_cast<std::size_t>(buffer_end - list.begin()), begin + kMaxDispatchBlocks);
    params.list_begin = static_cast<int>(begin);
    params.pool_begin = static_cast<int>(buffer * blocks_per_buffer_);
    commands_->dispatch(kernels_.integrate, {kBlockSide * kBlockSide, static_cast<std::int64_t>(end - begin)}, params,
                        {surface->depth, surface->cells, surface->weights, *image, *list_buffer, pool_[buffer]});
    if (auto done = commands_->submit(); !done) return done;
    begin = end;
  }
  return {};
}

Expected<void> VolumeStage::carve_blocks(const FusionView& view) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  const std::vector<std::uint32_t> list = blocks_in_sight(view.map.depth, view.camera, grid_);
  if (list.empty()) return {};
  auto surface = record_surface(view);
  if (!surface) return std::unexpected(surface.error());
  IntegrateParams params = make_integrate_params(view.camera, width, height, grid_);
  commands_->region("carve_blocks");
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t buffer = list[begin] / empty_per_buffer_;
    const auto rest = std::span(list).subspan(begin, std::min(kMaxDispatchBlocks, list.size() - begin));
    const auto end = std::ranges::lower_bound(rest, (buffer + 1) * empty_per_buffer_);
    const auto part = rest.first(static_cast<std::size_t>(end - rest.begin()));
    auto list_buffer = Buffer::of(*device_, part);
    if (!list_buffer) return std::unexpected(list_buffer.error());
    params.pool_begin = static_cast<int>(buffer * empty_per_buffer_);
    commands_->dispatch(kernels_.carve_blocks, {static_cast<std::int64_t>(part.size() * sizeof(BlockBits) / 4)}, params,
                        {surface->depth, surface->cells, surface->weights, *list_buffer, empty_[buffer]});
    if (auto done = commands_->submit(); !done) return done;
    begin += part.size();
  }
  return {};
}

Expected<std::vector<BlockBits>> VolumeStage::read_empty() {
  std::vector<BlockBits> empty;
  try {
    empty.resize(grid_.block_count());
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::kMemory, fmt::format("reading empty voxels back needs {} MiB; give a larger --voxel-size",
                                                   grid_.block_count() * sizeof(BlockBits) >> 20));
  }
  for (std::size_t buffer = 0; buffer < empty_.size(); ++buffer) {
    const std::size_t first = buffer * empty_per_buffer_;
    const auto part = std::span(empty).subspan(first, std::min(empty_per_buffer_, empty.size() - first));
    if (auto read = empty_[buffer].download(part); !read) return std::unexpected(read.error());
  }
  empty_.clear();
  return empty;
}

Expected<BlockPool> VolumeStage::read_blocks() {
  BlockPool pool;
  pool.indices = std::exchange(indices_, {});
  try {
    pool.voxels.resize(pool.indices.size() * kBlockVoxels);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::kMemory, fmt::format("reading the volume back needs {} MiB; give a larger --voxel-size",
                                                   pool.indices.size() * kBlockBytes >> 20));
  }
  for (std::size_t buffer = 0; buffer < pool_.size(); ++buffer) {
    const std::size_t first = buffer * blocks_per_buffer_;
    const std::size_t count = std::min(blocks_per_buffer_, pool.indices.size() - first);
    const std::span<Voxel> part(pool.voxels.data() + first * kBlockVoxels, count * kBlockVoxels);
    if (auto read = pool_[buffer].download(part); !read) return std::unexpected(read.error());
  }
  pool_.clear();
  return pool;
}

}  // namespace quorum
