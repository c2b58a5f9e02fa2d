#include "engine/pipeline/memory_estimates.h"

#include <algorithm>

#include "engine/mesh/mesh.h"
#include "engine/volume/confirm_depths.h"
#include "engine/volume/slabs.h"
#include "engine/volume/voxel_grid.h"

namespace quorum {
namespace {

std::uint64_t area(int width, int height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

std::uint64_t pixels_of(const View& view) { return area(view.width, view.height); }
std::uint64_t photograph_pixels_of(const View& view) { return area(view.photo_width, view.photo_height); }

/// Of the largest of the views.
std::uint64_t most_pixels(const Scene& scene, const std::vector<int>& views) {
  std::uint64_t most = 0;
  for (const int view : views) most = std::max(most, pixels_of(scene.views[view]));
  return most;
}

template <typename Area>
std::uint64_t most(const Scene& scene, const Area& area_of) {
  std::uint64_t largest = 0;
  for (const View& view : scene.views) largest = std::max(largest, area_of(view));
  return largest;
}

constexpr std::uint64_t kDistortedBytes = 12;  // a pixel of a photograph: file, decoded, in color

}  // namespace

MemoryEstimate depth_map_memory(const Scene& scene, const RunOptions& options, const Backend& backend) {
  const std::uint64_t pixels = most(scene, pixels_of);
  const auto images = static_cast<std::uint64_t>(1 + options.views.neighbor_count);
  const std::uint64_t half = options.sweep.half_size ? 1 : 0;
  const std::uint64_t second = options.sweep.second_window == 0 ? 0 : 1;
  return {{{"SweepTask: padded images, of two views", 2 * 4 * images * pixels},
           {"SweepTask::ranges, of two views", 2 * 8 * pixels},
           {"SmallImages: of two views, and one as it is halved", (5 * images / 2 + 10) * pixels},
           {"make_half_task: ranges and maps", half * 14 * pixels},
           {"ImageStore: a photograph and its mask, of two views", 2 * 6 * pixels},
           {"undistort: a photograph as it is read", kDistortedBytes * most(scene, photograph_pixels_of)},
           {"Workspace::save_depth_map: four maps and normals, a file's bytes, pictures", 56 * pixels},
           {"make_second_task: the first maps, and other ranges", second * 32 * pixels},
           {"Backend::sweep_depth", backend.view_bytes(pixels, options.views.neighbor_count)}}};
}

MemoryEstimate depth_map_in_flight_memory(const Scene& scene, const RunOptions& options, const Backend& backend) {
  const std::uint64_t pixels = most(scene, pixels_of);
  const auto images = static_cast<std::uint64_t>(1 + options.views.neighbor_count);
  const std::uint64_t works = backend.views_at_once() > 1 ? 1 : 0;
  return {{{"SweepTask: padded images and ranges", (4 * images + 8) * pixels},
           {"SmallImages: and one as it is halved", (5 * images / 4 + 6) * pixels},
           {"ImageStore: a photograph and its mask", 6 * pixels},
           {"undistort: a photograph as it is read", kDistortedBytes * most(scene, photograph_pixels_of)},
           {"Workspace::save_depth_map: maps and normals, a file's bytes, pictures", 56 * pixels},
           {"make_half_task: ranges and maps", works * 14 * pixels},
           {"Backend::sweep_depth", works * backend.view_bytes(pixels, options.views.neighbor_count)}}};
}

MemoryEstimate confirm_memory(const Scene& scene, const std::vector<int>& views, const Backend& backend) {
  const std::uint64_t pixels = most_pixels(scene, views);
  return {{{"ConfirmTask: depths and certainties, of two views", 2 * 8 * (1 + kConfirmingViews) * pixels},
           {"views that were read last", 8 * kRecentViews * pixels},
           {"confirm_depths: support and certainty", (4 + 8) * pixels},
           {"Workspace::save_certainty: the map, a file's bytes, a picture", 16 * pixels},
           {"Backend::confirm_depths", backend.view_bytes(pixels, 0)}}};
}

MemoryEstimate confirm_in_flight_memory(const Scene& scene, const std::vector<int>& views, const Backend& backend) {
  const std::uint64_t pixels = most_pixels(scene, views);
  const std::uint64_t works = backend.views_at_once() > 1 ? 1 : 0;
  return {{{"ConfirmTask: depths and certainties", 8 * (1 + kConfirmingViews) * pixels},
           {"Backend::confirm_depths", works * backend.view_bytes(pixels, 0)},
           {"Workspace::save_certainty: the map, a file's bytes, a picture", 16 * pixels}}};
}

MemoryEstimate merge_in_flight_memory(const Scene& scene, const std::vector<int>& views) {
  const std::uint64_t pixels = most_pixels(scene, views);
  return {{{"Workspace::load_depth_map, load_normals: maps and a file's bytes", (16 + 20) * pixels},
           {"ImageStore: a photograph and its padded copy", 12 * pixels}}};
}

MemoryEstimate merge_memory(const Scene& scene, const std::vector<int>& views, const VoxelGrid& grid,
                            const Backend& backend) {
  const std::uint64_t pixels = most_pixels(scene, views);
  return {{{"Workspace::load_depth_map: three maps and a file's bytes, of two views", 2 * 16 * pixels},
           {"Workspace::load_normals, pack_normals: normals, a file's bytes, words, of two views", 2 * 20 * pixels},
           {"ImageStore: a photograph and its padded copy, of two views", 2 * 12 * pixels},
           {"collect_blocks: bits of blocks, twice", grid.block_count() / 4},
           {"Backend::integrate", backend.view_bytes(pixels, 0)}}};
}

MemoryEstimate empty_space_memory(const VoxelGrid& grid, const FusionOptions& options, int copies) {
  const std::uint64_t bits = options.fill_holes ? sizeof(BlockBits) * grid.block_count() : 0;
  return {{{"EmptySpace: bits of voxels", static_cast<std::uint64_t>(copies) * bits}}};
}

std::uint64_t block_surface_bytes(const FusionOptions& options) {
  // MarchingCubes: signs, and room for 32 vertices; a scan has some 16. If holes are filled, weights.
  return 1280 + (options.fill_holes ? kBlockVoxels * sizeof(std::uint16_t) : 0);
}

namespace {

// Of a vertex: numbers, two triangles and their copy, a normal in double, components, the cleaned vertex. make_manifold
// has the cleaned mesh alone, and of each vertex six edges and corners.
constexpr std::uint64_t kVertexBytes = 192;
constexpr std::uint64_t kBlockBytes = 212;

}  // namespace

MemoryEstimate mesh_memory(std::uint64_t vertices, std::uint64_t blocks) {
  return {{{"MarchingCubes::finish, clean: vertices and triangles", kVertexBytes * vertices},
           {"MarchingCubes: blocks", kBlockBytes * blocks}}};
}

MemoryEstimate filled_surface_memory(std::uint64_t vertices, std::uint64_t blocks) {
  return {{{"FilledSurface::extract: a vertex, two triangles, a patch", 72 * vertices},
           {"FilledSurface: blocks", kBlockBytes * blocks}}};
}

MemoryEstimate settling_memory(std::uint64_t vertices) {
  return {{{"clean: vertices and triangles", kVertexBytes * vertices},
           {"settle_filled: colors, positions and their sums in double, triangles around", 64 * vertices}}};
}

MemoryEstimate cloud_memory(const Scene& scene, int reference, const std::vector<int>& neighbors, std::uint64_t points,
                            std::uint64_t room) {
  const View& view = scene.views[reference];
  const std::uint64_t pixels = pixels_of(view);
  std::uint64_t all_pixels = pixels;
  for (const int neighbor : neighbors) all_pixels += pixels_of(scene.views[neighbor]);
  const std::uint64_t grown = points + pixels;  // if each pixel made a point
  return {{{"Workspace::load_depth_map: three maps, of the view and its neighbors", 12 * all_pixels},
           {"Workspace::load_normals: normals, a file's bytes", (12 + 4) * pixels},
           {"ImageStore: the photograph", 8 * pixels},
           {"undistort: a photograph as it is read", kDistortedBytes * photograph_pixels_of(view)},
           {"Mesh::vertices of the cloud", grown > room ? std::max(2 * points, grown) * sizeof(Vertex) : 0}}};
}

MemoryEstimate cloud_file_memory(std::uint64_t points) {
  return {{{"write_ply: bytes of points, in double", 47 * points}}};
}

MemoryEstimate colmap_memory(const Scene& scene, const std::vector<int>& views,
                             const std::vector<std::size_t>& neighbor_count) {
  constexpr std::uint64_t kPointBytes = 200;  // in memory and as bytes
  constexpr std::uint64_t kSightingBytes = 100;
  const std::uint64_t pixels = most(scene, pixels_of);
  std::uint64_t points = 0;
  for (const SparsePoint& point : scene.points) points += kPointBytes + kSightingBytes * point.views.size();
  if (scene.points.empty())  // one for every 64 pixels of a depth map, as add_points makes them
    for (std::size_t i = 0; i < views.size(); ++i)
      points += pixels_of(scene.views[views[i]]) / 64 * (kPointBytes + kSightingBytes * (1 + neighbor_count[i]));
  return {{{"Workspace::load_depth_map: a view's three maps", 12 * pixels},
           {"Workspace::load_depth_map: a neighbor's", 12 * pixels},
           {"Workspace::load_normals", 12 * pixels},
           {"write_colmap_map: bytes of a file", 12 * pixels},
           {"write_pictures: a photograph", 16 * std::max(pixels, most(scene, photograph_pixels_of))},
           {"ColmapModel: points", points}}};
}

SurfaceEstimate estimate_surface(const Scene& scene, const VoxelGrid& grid) {
  constexpr double kLayers = 3.74;  // blocks to one that a flat surface as large as the box's would take
  constexpr double kVerticesPerBlock = 14.0;
  const Eigen::Vector3d size = scene.bounds.high - scene.bounds.low;
  const double box = 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  // No more than all pixels show.
  double pixels = 0.0;
  for (const View& view : scene.views) pixels += static_cast<double>(pixels_of(view));
  FusionOptions automatic;
  const auto finest = make_voxel_grid(scene, automatic);
  const double footprint = finest ? finest->voxel_size : grid.voxel_size;
  const double area = std::min(box, pixels * footprint * footprint);
  const double side = kBlockSide * grid.voxel_size;
  SurfaceEstimate surface;
  surface.blocks =
      static_cast<std::uint64_t>(std::min(kLayers * area / (side * side), static_cast<double>(grid.block_count())));
  surface.vertices = static_cast<std::uint64_t>(kVerticesPerBlock * static_cast<double>(surface.blocks));
  surface.triangles = 2 * surface.vertices;
  return surface;
}

std::uint64_t least_run_bytes(const Scene& scene, const RunOptions& options, const Backend& backend,
                              const VoxelGrid& grid) {
  std::vector<int> views;
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) views.push_back(view);
  const SurfaceEstimate surface = estimate_surface(scene, grid);
  const std::uint64_t kept = 160 * surface.blocks + sizeof(Vertex) * surface.vertices;  // of slabs before
  const std::uint64_t slab = kLeastSlabBlocks * (kBlockVoxels * sizeof(Voxel) + block_surface_bytes(options.fusion));
  const std::uint64_t holes = empty_space_memory(grid, options.fusion, 4).total();
  return std::max({depth_map_memory(scene, options, backend).total(), confirm_memory(scene, views, backend).total(),
                   merge_memory(scene, views, grid, backend).total() + holes + slab + kept,
                   mesh_memory(surface.vertices, surface.blocks).total() + holes + kept});
}

}  // namespace quorum
