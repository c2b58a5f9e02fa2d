#include "engine/pipeline/fuse_views.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "engine/mesh/fill_holes.h"
#include "engine/pipeline/background_thread.h"
#include "engine/volume/slabs.h"

namespace quorum {
namespace {

constexpr std::uint64_t kVoxelBytes = kBlockVoxels * sizeof(Voxel);  // of a block

/// Of a block: signs, and room for 32 vertices; a scan has some 16. If holes are filled, weights.
std::uint64_t surface_bytes(const FusionInput& input) {
  return 1280 + (input.options.fill_holes ? kBlockVoxels * sizeof(std::uint16_t) : 0);
}

/// Indices of blocks, ascending.
using Blocks = std::vector<std::uint32_t>;

struct CollectedBlocks {
  std::vector<Blocks> of_view;
  Blocks all;
  std::size_t views_with_background = 0;  ///< that carving saw, around the object
};

/// What a view takes while it is merged: its maps and photograph, and the next view's, which are read meanwhile; a bit
/// for every block of the grid.
std::uint64_t view_bytes(const FusionInput& input) {
  constexpr std::uint64_t kInputBytes = 28;  // a pixel: three maps, a file's bytes, the photograph and its padded copy
  std::uint64_t pixels = 0;
  for (const int index : input.views) {
    const View& view = input.scene.views[static_cast<std::size_t>(index)];
    pixels = std::max(pixels, static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height));
  }
  return 2 * kInputBytes * pixels + input.backend.view_bytes(pixels, 0) + input.grid.block_count() / 4;
}

/// A bit for each voxel of the grid; none if holes are not filled.
std::uint64_t empty_bytes(const FusionInput& input) {
  return input.options.fill_holes ? sizeof(BlockBits) * input.grid.block_count() : 0;
}

/// Sets kBackgroundDepth where the mask leaves pixels out and no depth was found.
Expected<void> mark_background(const FusionInput& input, int view, Grid<float>& depth) {
  const auto mask = input.images.mask(view);
  if (!mask) return std::unexpected(mask.error());
  for (std::size_t pixel = 0; pixel < (*mask)->values.size(); ++pixel)
    if ((*mask)->values[pixel] == 0 && depth.values[pixel] <= 0.0F) depth.values[pixel] = kBackgroundDepth;
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
};

/// Calls use(place, map, image) for the given places in input.views, in order, while the next view is read. The image
/// is empty if none is wanted; then, if holes are filled, depths tell the background.
template <typename Use>
Expected<void> for_each_view(const FusionInput& input, const std::vector<std::size_t>& places, bool with_image,
                             const Use& use) {
  BackgroundThread reader;
  const auto read = [&](std::size_t place) {
    return reader.run([&input, index = input.views[place], with_image]() -> Expected<LoadedView> {
      const View& view = input.scene.views[static_cast<std::size_t>(index)];
      auto map = input.workspace.load_depth_map(view.name, view.width, view.height);
      if (!map) return std::unexpected(map.error());
      if (input.confirmed) {
        auto certainty = input.workspace.load_certainty(view.name, view.width, view.height);
        if (!certainty) return std::unexpected(certainty.error());
        map->confidence = std::move(*certainty);
      }
      if (!with_image) {
        if (input.options.fill_holes)
          if (auto marked = mark_background(input, index, map->depth); !marked) return std::unexpected(marked.error());
        return LoadedView{std::move(*map), {}};
      }
      const auto image = input.images.image(index);
      if (!image) return std::unexpected(image.error());
      return LoadedView{std::move(*map), pad_image(**image)};
    });
  };
  std::future<Expected<LoadedView>> reading;
  if (!places.empty()) reading = read(places[0]);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (input.progress.stop_requested())
      return failure(ErrorKind::kStopped, "stopped as asked; finished depth maps are kept");
    const Expected<LoadedView> loaded = reading.get();
    if (i + 1 < places.size()) reading = read(places[i + 1]);
    if (!loaded) return std::unexpected(loaded.error());
    const Camera& camera = input.scene.views[static_cast<std::size_t>(input.views[places[i]])].camera;
    if (auto used = use(places[i], FusionView{loaded->map, loaded->image, camera}); !used) return used;
    input.progress.step();
  }
  add_stage(input.report, reader.time("load_depth_maps"));
  return {};
}

/// The blocks near the surface of each view. If holes are filled, each view marks what it looks through, too.
Expected<CollectedBlocks> collect_blocks(const FusionInput& input) {
  const StageTimer timer(input.report, "collect_blocks");
  input.progress.stage("finding voxel blocks", static_cast<int>(input.views.size()));
  CollectedBlocks collected;
  std::vector<std::size_t> places(input.views.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  auto done = for_each_view(input, places, false, [&](std::size_t, const FusionView& view) -> Expected<void> {
    auto blocks = input.backend.collect_blocks(view);
    if (!blocks) return std::unexpected(blocks.error());
    Blocks merged;
    merged.reserve(collected.all.size() + blocks->size());
    std::ranges::set_union(collected.all, *blocks, std::back_inserter(merged));
    collected.all = std::move(merged);
    input.report.block_views += blocks->size();
    collected.of_view.push_back(std::move(*blocks));
    if (!input.options.fill_holes) return {};
    collected.views_with_background += has_background(view.map.depth) ? 1 : 0;
    return input.backend.carve_blocks(view);
  });
  if (!done) return std::unexpected(done.error());
  input.report.blocks = collected.all.size();
  return collected;
}

/// Merges the views that see a slab into it, and reads it back.
Expected<BlockPool> fill_slab(const FusionInput& input, const CollectedBlocks& collected, const Slab& slab) {
  {
    const StageTimer timer(input.report, "integrate");
    std::vector<Blocks> seen(input.views.size());
    std::vector<std::size_t> places;  // of the views that see the slab
    for (std::size_t place = 0; place < input.views.size(); ++place) {
      std::ranges::set_intersection(collected.of_view[place], slab.blocks, std::back_inserter(seen[place]));
      if (!seen[place].empty()) places.push_back(place);
    }
    input.progress.stage("merging depth maps", static_cast<int>(places.size()));
    if (auto allocated = input.backend.allocate_blocks(slab.blocks); !allocated)
      return std::unexpected(allocated.error());
    auto done = for_each_view(input, places, true, [&](std::size_t place, const FusionView& view) {
      return input.backend.integrate(view, seen[place]);
    });
    if (!done) return std::unexpected(done.error());
  }
  const StageTimer timer(input.report, "read_blocks");
  return input.backend.read_blocks();
}

/// The largest slab from block `first` on that the budget holds now.
Expected<Slab> next_slab(const FusionInput& input, const Blocks& blocks, std::size_t first) {
  const std::uint64_t view = view_bytes(input);
  const std::uint64_t surface = surface_bytes(input);
  const auto voxel_room = [&](std::uint64_t room) { return room / (kVoxelBytes + surface) * kVoxelBytes; };
  std::uint64_t least = kLeastSlabBlocks * (kVoxelBytes + surface);
  while (input.backend.max_blocks(voxel_room(least)) < kLeastSlabBlocks) least *= 2;
  if (auto fits = input.budget.require(view + least, "merging depth maps"); !fits) return std::unexpected(fits.error());
  const std::uint64_t room = std::max(input.budget.left(), view + least) - view;
  return make_slab(blocks, first, input.grid, input.backend.max_blocks(voxel_room(room)));
}

// Of a vertex: numbers, two triangles and their copy, a normal in double, components, the cleaned vertex.
constexpr std::uint64_t kVertexBytes = 120;
constexpr std::uint64_t kBlockBytes = 212;

/// The surface without holes.
Expected<Mesh> extract_filled(const FusionInput& input, MarchingCubes& cubes, EmptySpace empty) {
  // While free space is looked for: the voxels that are wide enough, those that are free, and a copy.
  if (auto fits = input.budget.require(3 * empty_bytes(input), "filling holes"); !fits)
    return std::unexpected(fits.error());
  const float least = input.min_confidence(cubes.vertices());
  FilledSurface surface(cubes.take(), std::move(empty), least);
  // Of a vertex: itself, two triangles, its patch.
  constexpr std::uint64_t kExtractedBytes = 72;
  if (auto fits = input.budget.require(kExtractedBytes * surface.vertex_count() + kBlockBytes * surface.block_count(),
                                       "the mesh");
      !fits)
    return std::unexpected(fits.error());
  Mesh mesh = surface.extract();
  // What cleaning takes, and before it colors, positions and their sums in double, triangles around.
  constexpr std::uint64_t kSettledBytes = kVertexBytes + 64;
  if (auto fits = input.budget.require(kSettledBytes * mesh.vertices.size(), "the mesh"); !fits)
    return std::unexpected(fits.error());
  settle_filled(mesh);
  return mesh;
}

}  // namespace

Expected<Mesh> fuse_views(const FusionInput& input) {
  // Bits of empty voxels are there twice while they are read back, and four times while holes are filled.
  if (auto fits = input.budget.require(view_bytes(input) + 4 * empty_bytes(input), "finding voxel blocks"); !fits)
    return std::unexpected(fits.error());
  if (auto begun = input.backend.begin_volume(input.grid, input.options); !begun) return std::unexpected(begun.error());
  const auto collected = collect_blocks(input);
  if (!collected) return std::unexpected(collected.error());

  EmptySpace empty;
  if (input.options.fill_holes) {
    auto read = input.backend.read_empty();
    if (!read) return std::unexpected(read.error());
    empty.voxels = std::move(*read);
    empty.beyond_grid = 2 * collected->views_with_background > input.views.size();
    for (const int view : input.views)
      empty.cameras.push_back(input.scene.views[static_cast<std::size_t>(view)].camera.center());
  }
  MarchingCubes surface(input.grid, input.options.fill_holes);
  surface.reserve(collected->all.size());
  for (std::size_t first = 0; first < collected->all.size();) {
    const auto slab = next_slab(input, collected->all, first);
    if (!slab) return std::unexpected(slab.error());
    const auto pool = fill_slab(input, *collected, *slab);
    if (!pool) return std::unexpected(pool.error());
    const StageTimer timer(input.report, "marching_cubes");
    surface.add(*pool, slab->core_count);
    first += slab->core_count;
    ++input.report.slabs;
  }
  const StageTimer timer(input.report, "marching_cubes");
  input.progress.stage("extracting the mesh", 1);
  if (input.options.fill_holes) return extract_filled(input, surface, std::move(empty));
  if (auto fits = input.budget.require(kVertexBytes * surface.vertices().size() + kBlockBytes * collected->all.size(),
                                       "the mesh");
      !fits)
    return std::unexpected(fits.error());
  return surface.finish();
}

}  // namespace quorum
