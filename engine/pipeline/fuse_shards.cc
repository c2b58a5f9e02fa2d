#include "engine/pipeline/fuse_shards.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/io/file.h"
#include "engine/pipeline/confirm_views.h"
#include "engine/pipeline/provenance.h"
#include "engine/pipeline/surface_part.h"

namespace quorum {
namespace {

constexpr const char* kStage = "fuse";

std::filesystem::path part_path(const Run& run, const Shard& shard) {
  return run.workspace.shard_path(kStage, shard, "part");
}

/// The shards that are to be joined: of those into as many as there are parts of, or fails for what is missing.
Expected<std::vector<Shard>> find_all(const Run& run) {
  const std::vector<Shard> found = run.workspace.find_shards(kStage, "part");
  std::vector<Shard> most;
  for (auto first = found.begin(); first != found.end();) {
    const auto end = std::find_if(first, found.end(), [&](const Shard& shard) { return shard.count != first->count; });
    std::vector<Shard> group(first, end);
    if (static_cast<int>(group.size()) == group[0].count) return group;
    if (group.size() > most.size()) most = group;
    first = end;
  }
  const std::string folder = run.workspace.folder().string();
  if (most.empty())
    return failure(
        ErrorKind::kInput,
        fmt::format("{}: holds no part of a surface; run `quorum fuse` with --shard 1/N to N/N first", folder));
  int missing = 0;
  while (std::ranges::find(most, Shard{missing, most[0].count}) != most.end()) ++missing;
  return failure(ErrorKind::kInput,
                 fmt::format("{}: {} of {} parts of the surface are there; run `quorum fuse --shard {}` first", folder,
                             most.size(), most[0].count, Shard{missing, most[0].count}.text()));
}

/// Adds what a shard measured.
Expected<void> append_part(Run& run, const Shard& shard, const std::string& record, MeasuredVolume& all) {
  const std::filesystem::path path = part_path(run, shard);
  QUORUM_ASSIGN(const SurfacePart part, read_surface_part(path));
  if (part.record != record)
    return failure(ErrorKind::kInput,
                   fmt::format("{}: was made of other depth maps or with other options; run `quorum fuse --shard {}` "
                               "again",
                               path.string(), shard.text()));
  const MeasuredSurface& surface = part.volume.surface;
  const bool fills = run.options.fusion.fill_holes;
  const std::size_t grid_blocks = all.surface.grid.block_count();
  const bool fits = surface.indices.empty() ||
                    (surface.indices.back() < grid_blocks && surface.weights.empty() != fills &&
                     (all.surface.indices.empty() || all.surface.indices.back() < surface.indices.front()));
  if (!fits || part.volume.empty.size() != (fills ? grid_blocks : 0))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: does not fit the other parts; remove it and run `quorum fuse --shard {}` again",
                               path.string(), shard.text()));
  all.surface.append(surface);
  all.views_with_background += part.volume.views_with_background;
  all.empty.resize(part.volume.empty.size());
  for (std::size_t block = 0; block < all.empty.size(); ++block)
    for (std::size_t word = 0; word < all.empty[block].size(); ++word)
      all.empty[block][word] |= part.volume.empty[block][word];
  run.report.blocks = part.blocks;
  run.report.block_views = part.block_views;
  run.report.slabs += static_cast<int>(part.slabs);
  return {};
}

/// The parts while they are read: all of them, and one as bytes and as arrays.
MemoryEstimate joining_memory(const Run& run, const std::vector<Shard>& shards) {
  std::uint64_t all = 0;
  std::uint64_t largest = 0;
  for (const Shard& shard : shards) {
    std::error_code code;
    const std::uint64_t bytes = std::filesystem::file_size(part_path(run, shard), code);
    if (code) continue;
    all += bytes;
    largest = std::max(largest, bytes);
  }
  // Arrays that grow are there twice for a moment.
  return {{{"join_shards: the surface", 2 * all}, {"read_surface_part: bytes and arrays", 2 * largest}}};
}

}  // namespace

Expected<void> fuse_shard(Run& run, const std::vector<int>& views) {
  const Shard shard = *run.options.shard;
  QUORUM_TRY(check_certainties(run, views));
  QUORUM_ASSIGN(const VoxelGrid grid, make_voxel_grid(run.scene, run.options.fusion));
  SurfacePart part;
  part.record = Provenance(run).surface_record(views, grid, shard);
  if (read_surface_record(part_path(run, shard)) == part.record) {
    run.progress.note(fmt::format("part {} of the surface is there, made of the same", shard.text()));
    return {};
  }
  remove_file(part_path(run, shard));
  QUORUM_ASSIGN(part.volume, measure_volume(run, views));
  part.blocks = run.report.blocks;
  part.block_views = run.report.block_views;
  part.slabs = static_cast<std::uint64_t>(run.report.slabs);
  const StageTimer timer(run.report, "save_part");
  return write_surface_part(part_path(run, shard), part);
}

Expected<Mesh> join_shards(Run& run, const std::vector<int>& views) {
  QUORUM_ASSIGN(const std::vector<Shard> shards, find_all(run));
  QUORUM_TRY(run.require(joining_memory(run, shards), "joining shards"));
  QUORUM_ASSIGN(const VoxelGrid grid, make_voxel_grid(run.scene, run.options.fusion));
  run.report.voxel_size = grid.voxel_size;
  run.report.truncation = grid.truncation;
  MeasuredVolume all;
  all.surface.grid = grid;
  {
    const StageTimer timer(run.report, "load_parts");
    run.progress.stage("joining shards", static_cast<int>(shards.size()));
    Provenance provenance(run);
    for (const Shard& shard : shards) {
      if (run.progress.stop_requested()) return std::unexpected(stopped());
      QUORUM_TRY(append_part(run, shard, provenance.surface_record(views, grid, shard), all));
      run.progress.step();
    }
  }
  return extract_mesh(run, views, std::move(all));
}

Expected<void> take_part_options(RunOptions& options, const Workspace& workspace) {
  for (const Shard& shard : workspace.find_shards(kStage, "part"))
    if (const std::string record = read_surface_record(workspace.shard_path(kStage, shard, "part")); !record.empty())
      return take_surface_options(options, record);
  return {};
}

}  // namespace quorum
