#include "engine/pipeline/fuse_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/io/image_store.h"
#include "engine/mesh/drop_specks.h"
#include "engine/mesh/fill_holes.h"
#include "engine/mesh/filled_patches.h"
#include "engine/pipeline/view_loop.h"
#include "engine/volume/range_surface.h"
#include "engine/volume/slabs.h"

namespace quorum {
namespace {

constexpr std::uint64_t kVoxelBytes = kBlockVoxels * sizeof(Voxel);  // of a block

/// Indices of blocks, ascending.
using Blocks = std::vector<std::uint32_t>;

/// What the fusion works with.
struct Fusion {
  Run& run;
  const std::vector<int>& views;
  const VoxelGrid& grid;
  ImageStore& images;

  [[nodiscard]] bool fills_holes() const { return run.options.fusion.fill_holes; }
};

struct CollectedBlocks {
  std::vector<Blocks> of_view;  ///< by the view's index in the scene
  Blocks all;
  std::size_t views_with_background = 0;  ///< that carving saw, around the object
};

/// Sets kBackgroundDepth where the mask leaves pixels out and no depth was found.
Expected<void> mark_background(const Fusion& fusion, int view, Grid<float>& depth) {
  QUORUM_ASSIGN(const auto mask, fusion.images.mask(view));
  for (std::size_t pixel = 0; pixel < mask->values.size(); ++pixel)
    if (mask->values[pixel] == 0 && depth.values[pixel] <= 0.0F) depth.values[pixel] = kBackgroundDepth;
  return {};
}

/// Whether the view shows a background around the object, not just a few pixels that a mask leaves out.
bool has_background(const Grid<float>& depth) {
  constexpr std::int64_t kLeastShare = 10;  // one in so many pixels
  return kLeastShare * std::ranges::count(depth.values, kBackgroundDepth) >=
         static_cast<std::int64_t>(depth.values.size());
}

/// What is read of a view.
struct LoadedView {
  DepthMap map;
  PaddedImage image;
  Grid<std::uint32_t> normals;  ///< packed; empty if edges are not held against planes
};

/// The image is empty if none is wanted; then, if holes are filled, depths tell the background.
Expected<LoadedView> load_view(const Fusion& fusion, int index, bool with_image) {
  const View& view = fusion.run.view(index);
  const Workspace& workspace = fusion.run.workspace;
  LoadedView loaded;
  const bool confirmed = fusion.run.options.confirm;
  QUORUM_ASSIGN(loaded.map, workspace.load_weighed_depth(view.name, view.width, view.height, confirmed));
  if (confirmed) leave_out_dropped(loaded.map.confidence, loaded.map.depth);
  if (fusion.run.options.fusion.plane_agreement > 0) {
    QUORUM_ASSIGN(const auto normals, workspace.load_normals(view.name, view.width, view.height));
    loaded.normals = pack_normals(normals);
  }
  if (!with_image) {
    if (fusion.fills_holes()) QUORUM_TRY(mark_background(fusion, index, loaded.map.depth));
    return loaded;
  }
  QUORUM_ASSIGN(const auto image, fusion.images.image(index));
  loaded.image = pad_image(*image);
  return loaded;
}

/// Calls use(view, map, image) for the views, in order. least: what this takes at most with one view in flight.
template <typename Use>
Expected<void> for_each_map(const Fusion& fusion, const std::vector<int>& views, bool with_image,
                            const MemoryEstimate& least, const Use& use) {
  ViewsInFlight in_flight = views_in_flight(fusion.run, least, merge_in_flight_memory(fusion.run.scene, fusion.views));
  in_flight.workers = 1;  // a volume takes one view at a time
  const auto read = [&](int view) { return load_view(fusion, view, with_image); };
  const auto work = [&](int view, const LoadedView& loaded) {
    return use(view, FusionView{loaded.map, loaded.image, fusion.run.view(view).camera,
                                loaded.normals.empty() ? nullptr : &loaded.normals});
  };
  return for_each_view(fusion.run, views, {.read = "load_depth_maps"}, read, work, in_flight);
}

/// Whether a view's share of the work is this run's.
bool is_own(const Run& run, int view) { return !run.options.shard || run.options.shard->has(view); }

/// The blocks near the surface of each view. If holes are filled, each view marks what it looks through, too.
Expected<CollectedBlocks> collect_blocks(const Fusion& fusion, const MemoryEstimate& memory) {
  const StageTimer timer(fusion.run.report, "collect_blocks");
  fusion.run.progress.stage("finding voxel blocks", static_cast<int>(fusion.views.size()));
  CollectedBlocks collected;
  collected.of_view.resize(fusion.run.scene.views.size());
  QUORUM_TRY(
      for_each_map(fusion, fusion.views, false, memory, [&](int index, const FusionView& view) -> Expected<void> {
        QUORUM_ASSIGN(Blocks blocks, fusion.run.backend.collect_blocks(view));
        Blocks merged;
        merged.reserve(collected.all.size() + blocks.size());
        std::ranges::set_union(collected.all, blocks, std::back_inserter(merged));
        collected.all = std::move(merged);
        fusion.run.report.block_views += blocks.size();
        collected.of_view[static_cast<std::size_t>(index)] = std::move(blocks);
        if (!fusion.fills_holes() || !is_own(fusion.run, index)) return {};
        collected.views_with_background += has_background(view.map.depth) ? 1 : 0;
        return fusion.run.backend.carve_blocks(view);
      }));
  fusion.run.report.blocks = collected.all.size();
  return collected;
}

/// What a slab of so many blocks takes, with one view in flight.
MemoryEstimate slab_memory(const Fusion& fusion, std::size_t blocks) {
  MemoryEstimate memory = merge_memory(fusion.run.scene, fusion.views, fusion.grid, fusion.run.backend);
  memory.items.push_back({"BlockPool, MarchingCubes: blocks of the slab",
                          blocks * (kVoxelBytes + block_surface_bytes(fusion.run.options.fusion))});
  return memory;
}

/// Merges the views that see a slab into it, and reads it back.
Expected<BlockPool> fill_slab(const Fusion& fusion, const CollectedBlocks& collected, const Slab& slab) {
  const MemoryEstimate memory = slab_memory(fusion, slab.blocks.size());
  Backend& backend = fusion.run.backend;
  {
    const StageTimer timer(fusion.run.report, "integrate");
    std::vector<Blocks> seen(collected.of_view.size());
    std::vector<int> views;  // that see the slab
    for (const int view : fusion.views) {
      const auto place = static_cast<std::size_t>(view);
      std::ranges::set_intersection(collected.of_view[place], slab.blocks, std::back_inserter(seen[place]));
      if (!seen[place].empty()) views.push_back(view);
    }
    fusion.run.progress.stage("merging depth maps", static_cast<int>(views.size()));
    QUORUM_TRY(backend.allocate_blocks(slab.blocks));
    QUORUM_TRY(for_each_map(fusion, views, true, memory, [&](int index, const FusionView& view) {
      return backend.integrate(view, seen[static_cast<std::size_t>(index)]);
    }));
  }
  const StageTimer timer(fusion.run.report, "read_blocks");
  return backend.read_blocks();
}

/// The largest slab from block `first` on, before block `end`, that the budget holds now.
Expected<Slab> next_slab(const Fusion& fusion, const Blocks& blocks, std::size_t first, std::size_t end) {
  Run& run = fusion.run;
  const MemoryEstimate view = merge_memory(run.scene, fusion.views, fusion.grid, run.backend);
  const std::uint64_t block_bytes = kVoxelBytes + block_surface_bytes(run.options.fusion);
  const auto voxel_room = [&](std::uint64_t room) { return room / block_bytes * kVoxelBytes; };
  const auto with_blocks = [&](std::uint64_t bytes) {
    MemoryEstimate all = view;
    all.items.push_back({"BlockPool, MarchingCubes: blocks of the slab", bytes});
    return all;
  };
  std::uint64_t least = kLeastSlabBlocks * block_bytes;
  while (run.backend.max_blocks(voxel_room(least)) < kLeastSlabBlocks) least *= 2;
  QUORUM_TRY(run.require(with_blocks(least), "merging depth maps"));
  const std::uint64_t room = std::max(run.budget.left(), view.total() + least) - view.total();
  Slab slab = make_slab(blocks, first, end, fusion.grid, run.backend.max_blocks(voxel_room(room)));
  run.expect(with_blocks(std::max(least, slab.blocks.size() * block_bytes)));
  return slab;
}

/// The surface without holes.
Expected<Mesh> extract_filled(Run& run, const std::vector<int>& views, MeasuredVolume volume) {
  EmptySpace empty{std::move(volume.empty), 2 * volume.views_with_background > views.size(), {}};
  for (const int view : views) empty.cameras.push_back(run.view(view).camera.center());
  // While free space is looked for: the voxels that are wide enough, those that are free, and a copy.
  QUORUM_TRY(run.require(empty_space_memory(volume.surface.grid, run.options.fusion, 3), "filling holes"));
  const float least = least_confidence(run, volume.surface.vertices);
  FilledSurface surface(std::move(volume.surface), std::move(empty), least);
  QUORUM_TRY(run.require(filled_surface_memory(surface.vertex_count(), surface.block_count()), "the mesh"));
  Mesh mesh = surface.extract();
  QUORUM_TRY(run.require(settling_memory(mesh.vertices.size()), "the mesh"));
  settle_filled(mesh);
  return mesh;
}

/// The run's part of the collected blocks, slab by slab.
Expected<MeasuredSurface> measure_slabs(const Fusion& fusion, const CollectedBlocks& collected) {
  Run& run = fusion.run;
  MarchingCubes surface(fusion.grid, fusion.fills_holes());
  auto [first, end] = run.options.shard.value_or(Shard()).range(collected.all.size());
  surface.reserve(end - first);
  while (first < end) {
    QUORUM_ASSIGN(const Slab slab, next_slab(fusion, collected.all, first, end));
    QUORUM_ASSIGN(const BlockPool pool, fill_slab(fusion, collected, slab));
    const StageTimer timer(run.report, "marching_cubes");
    surface.add(pool, slab.core_count);
    first += slab.core_count;
    ++run.report.slabs;
  }
  return surface.take();
}

}  // namespace

float least_confidence(Run& run, const std::vector<Vertex>& vertices) {
  constexpr float kConfirmed = 0.035F;  // docs/quality.md; without confirmation the default
  const auto automatic = [&] {
    return run.options.confirm ? automatic_min_confidence(vertices, kConfirmed) : automatic_min_confidence(vertices);
  };
  return run.report.min_confidence = run.options.min_confidence ? *run.options.min_confidence : automatic();
}

Expected<MeasuredVolume> measure_volume(Run& run, const std::vector<int>& views) {
  if (views.size() > static_cast<std::size_t>(kMaxIntegratedViews))
    return failure(ErrorKind::kInput, fmt::format("{} views are more than the {} that one volume takes", views.size(),
                                                  kMaxIntegratedViews));
  QUORUM_ASSIGN(const VoxelGrid grid, make_voxel_grid(run.scene, run.options.fusion));
  run.report.voxel_size = grid.voxel_size;
  run.report.truncation = grid.truncation;
  run.report.block_views = 0;
  run.report.slabs = 0;
  // A slab takes each photograph once, and the memory is better spent on large slabs.
  ImageStore images(run.scene, 0, run.options.mask_below);
  const Fusion fusion{run, views, grid, images};

  // Bits of empty voxels are there twice while they are read back, and four times while holes are filled.
  MemoryEstimate memory = merge_memory(run.scene, views, grid, run.backend);
  std::ranges::copy(empty_space_memory(grid, run.options.fusion, 4).items, std::back_inserter(memory.items));
  QUORUM_TRY(run.require(memory, "finding voxel blocks"));
  QUORUM_TRY(run.backend.begin_volume(grid, run.options.fusion));
  QUORUM_ASSIGN(const CollectedBlocks collected, collect_blocks(fusion, memory));
  MeasuredVolume volume;
  volume.views_with_background = collected.views_with_background;
  if (fusion.fills_holes()) {
    QUORUM_ASSIGN(volume.empty, run.backend.read_empty());
  }
  QUORUM_ASSIGN(volume.surface, measure_slabs(fusion, collected));
  return volume;
}

Expected<Mesh> extract_mesh(Run& run, const std::vector<int>& views, MeasuredVolume volume) {
  const StageTimer timer(run.report, "marching_cubes");
  run.progress.stage("extracting the mesh", 1);
  if (run.options.fusion.fill_holes) return extract_filled(run, views, std::move(volume));
  QUORUM_TRY(run.require(mesh_memory(volume.surface.vertices.size(), volume.surface.indices.size()), "the mesh"));
  return MarchingCubes(std::move(volume.surface)).finish();
}

Expected<Mesh> fuse_views(Run& run, const std::vector<int>& views) {
  QUORUM_ASSIGN(MeasuredVolume volume, measure_volume(run, views));
  return extract_mesh(run, views, std::move(volume));
}

}  // namespace quorum
