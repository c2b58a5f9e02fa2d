#include "host/volume_stage.h"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "engine/volume/collect_blocks.h"
#include "engine/volume/integrate.h"
#include "engine/volume/weigh_surface.h"

namespace quorum {
namespace {

constexpr std::size_t kBlockBytes = kBlockVoxels * sizeof(Voxel);
constexpr std::size_t kMaxDispatchBlocks =
    16384;  // 8 million voxels: some 10 ms, and within any maxComputeWorkGroupCount

}  // namespace

VolumeStage::VolumeStage(Commands& commands)
    : commands_(&commands),
      range_surface_(commands.kernel("range_surface")),
      weigh_surface_(commands.kernel("weigh_surface")),
      collect_blocks_(commands.kernel("collect_blocks")),
      integrate_(commands.kernel("integrate")),
      carve_blocks_(commands.kernel("carve_blocks")) {}

Expected<void> VolumeStage::begin(const VoxelGrid& grid, const FusionOptions& options) {
  grid_ = grid;
  fusion_ = options;
  indices_.clear();
  pool_ = {};
  return empty_.reset(*commands_, options.fill_holes ? grid_.block_count() : 0, sizeof(BlockBits), "empty voxels");
}

VolumeStage::Surface VolumeStage::record_surface(const FusionView& view) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  const std::size_t word_bytes = view.map.depth.values.size() * sizeof(std::uint32_t);
  Surface surface{
      .depth = commands_->upload(view.map.depth.values),
      .confidence = commands_->upload(view.map.confidence.values),
      .normals = commands_->upload(view.normals != nullptr ? view.normals->values : std::vector<std::uint32_t>(1)),
      .cells = commands_->allocate(word_bytes),
      .weights = commands_->allocate(word_bytes)};
  RangeSurfaceParams range = make_range_surface_params(view.camera, width, height, fusion_);
  if (view.normals == nullptr) range.agreement = 0;
  commands_->region("range_surface");
  commands_->dispatch(range_surface_, {width, height}, range, {surface.depth, surface.normals, surface.cells});
  commands_->region("weigh_surface");
  commands_->dispatch(weigh_surface_, {width, height}, make_weigh_surface_params(view.camera, width, height, fusion_),
                      {surface.depth, surface.confidence, surface.cells, surface.weights});
  return surface;
}

Expected<std::vector<std::uint32_t>> VolumeStage::collect_blocks(const FusionView& view) {
  const int width = view.map.depth.width;
  const int height = view.map.depth.height;
  const Surface surface = record_surface(view);
  std::vector<std::uint32_t> bits((grid_.block_count() + 31) / 32);
  const Buffer bit_buffer = commands_->upload(bits);
  commands_->region("collect_blocks");
  commands_->dispatch(collect_blocks_, {width, height}, make_collect_params(view.camera, width, height, grid_),
                      {surface.depth, surface.weights, bit_buffer});
  QUORUM_TRY(commands_->download(bit_buffer, bits));
  return block_indices(bits);
}

Expected<void> VolumeStage::allocate_blocks(std::vector<std::uint32_t> indices) {
  indices_ = std::move(indices);
  return pool_.reset(*commands_, indices_.size(), kBlockBytes,
                     fmt::format("volume of {} blocks, {} MiB", indices_.size(), indices_.size() * kBlockBytes >> 20));
}

Expected<void> VolumeStage::integrate(const FusionView& view, const std::vector<std::uint32_t>& blocks) {
  const std::vector<BlockSlot> list = find_slots(blocks, indices_);
  if (list.empty()) return {};
  const Surface surface = record_surface(view);
  const Buffer image = commands_->upload(view.image.pixels);
  const Buffer list_buffer = commands_->upload(list);
  IntegrateParams params = make_integrate_params(view.camera, view.map.depth.width, view.map.depth.height, grid_);
  commands_->region("integrate");
  for (std::span<const BlockSlot> rest = list; !rest.empty();) {
    const auto [part, voxels, first_block] = pool_.first_part(rest, kMaxDispatchBlocks, &BlockSlot::slot);
    params.list_begin = static_cast<int>(part.data() - list.data());
    params.pool_begin = first_block;
    commands_->dispatch(integrate_, {kBlockSide * kBlockSide, static_cast<std::int64_t>(part.size())}, params,
                        {surface.depth, surface.cells, surface.weights, image, list_buffer, voxels});
    QUORUM_TRY(commands_->submit());
    rest = rest.subspan(part.size());
  }
  return {};
}

Expected<void> VolumeStage::carve_blocks(const FusionView& view) {
  const std::vector<std::uint32_t> list = blocks_in_sight(view.map.depth, view.camera, grid_);
  if (list.empty()) return {};
  const Surface surface = record_surface(view);
  IntegrateParams params = make_integrate_params(view.camera, view.map.depth.width, view.map.depth.height, grid_);
  commands_->region("carve_blocks");
  for (std::span<const std::uint32_t> rest = list; !rest.empty();) {
    const auto [part, bits, first_block] = empty_.first_part(rest, kMaxDispatchBlocks);
    const Buffer list_buffer = commands_->upload(part);
    params.pool_begin = first_block;
    commands_->dispatch(carve_blocks_, {static_cast<std::int64_t>(part.size() * sizeof(BlockBits) / 4)}, params,
                        {surface.depth, surface.cells, surface.weights, list_buffer, bits});
    QUORUM_TRY(commands_->submit());
    rest = rest.subspan(part.size());
  }
  return {};
}

Expected<std::vector<BlockBits>> VolumeStage::read_empty() {
  return empty_.take<BlockBits>(*commands_, "empty voxels");
}

Expected<BlockPool> VolumeStage::read_blocks() {
  BlockPool pool;
  pool.indices = std::exchange(indices_, {});
  QUORUM_ASSIGN(pool.voxels, pool_.take<Voxel>(*commands_, "the volume"));
  return pool;
}

}  // namespace quorum
