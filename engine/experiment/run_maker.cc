#include "engine/experiment/run_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/core/memory.h"
#include "engine/experiment/pictures.h"
#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "engine/pipeline/reconstruct.h"
#include "engine/pipeline/run_json.h"
#include "engine/pipeline/stage_versions.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
class Digest {
 public:
  void add(const void* bytes, std::size_t count) {
    const auto* at = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ at[i]) * 0x100000001b3ULL;
  }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

std::string digest_of(const std::string& text) {
  Digest digest;
  digest.add(text.data(), text.size());
  return digest.text();
}

/// Of names, sizes of files, cameras and bounds.
std::string digest_of(const Scene& scene) {
  Digest digest;
  std::error_code ignored;
  for (const View& view : scene.views) {
    digest.add(view.name.data(), view.name.size());
    const std::uint64_t bytes = std::filesystem::file_size(view.image_path, ignored);
    digest.add(&bytes, sizeof(bytes));
    digest.add(view.camera.intrinsics.data(), sizeof(double) * 9);
    digest.add(view.camera.camera_from_world.data(), sizeof(double) * 9);
    digest.add(view.camera.translation.data(), sizeof(double) * 3);
  }
  digest.add(scene.bounds.low.data(), sizeof(double) * 3);
  digest.add(scene.bounds.high.data(), sizeof(double) * 3);
  return digest.text();
}

/// All that the depth maps of a run depend on, and what only the mesh does.
struct Identity {
  Json depth;
  Json fusion;

  [[nodiscard]] std::string text() const { return Json{{"depth", depth}, {"fusion", fusion}}.dump(); }
};

Identity identity_of(const OpenScene& scene, const RunSettings& settings) {
  const auto options = [&](RunStage first, RunStage last) {
    return Json::parse(options_json(settings.options, first, last));
  };
  return {.depth = {{"version", kDepthVersion},
                    {"scene", description(*scene.source)},
                    {"files", digest_of(scene.scene)},
                    {"first_views", settings.first_views},
                    {"options", options(RunStage::kScene, RunStage::kDepth)}},
          .fusion = {{"version", kFusionVersion}, {"options", options(RunStage::kConfirm, RunStage::kClean)}}};
}

std::string run_id(const RunRecord& record) { return fmt::format("{}-{}", record.scene, digest_of(record.identity)); }

/// Passes on the wish to stop and nothing else: a run is one step of the experiment's progress.
class SilentProgress : public Progress {
 public:
  explicit SilentProgress(const Progress& outer) : outer_(outer) {}
  [[nodiscard]] bool stop_requested() const override { return outer_.stop_requested(); }

 private:
  const Progress& outer_;
};

/// The scene with its first views alone.
OpenScene first_views(OpenScene scene, int count) {
  if (count > 0 && static_cast<std::size_t>(count) < scene.scene.views.size())
    scene.scene.views.resize(static_cast<std::size_t>(count));
  return scene;
}

/// True if some view has the two neighbors that a depth map takes.
bool can_find_depth(const Scene& scene, const SelectViewsOptions& options) {
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view)
    if (select_views(scene, view, options).size() >= 2) return true;
  return false;
}

}  // namespace

std::filesystem::path RunMaker::picture_path(const RunRecord& record, Picture picture) const {
  return folder_ / "runs" / run_id(record) / fmt::format("{}.png", to_string(picture));
}

Expected<const OpenScene*> RunMaker::open(const std::string& scene) {
  const ExperimentScene& source = find_scene(scenes_, scene);
  if (!open_ || open_->source != &source) {
    open_.reset();
    QUORUM_ASSIGN(auto opened, shelf_.open(source, progress_));
    open_ = std::make_unique<OpenScene>(std::move(opened));
  }
  return open_.get();
}

Expected<RunRecord> RunMaker::run(const RunSettings& settings) {
  was_made_ = false;
  QUORUM_ASSIGN(const auto opened, open(settings.scene));
  RunRecord record;
  record.scene = settings.scene;
  record.identity = identity_of(*opened, settings).text();
  record.device = backend_.description();
  const std::filesystem::path path = folder_ / "runs" / (run_id(record) + ".json");
  if (const auto text = read_file(path); text) {
    auto kept = read_record(*text);
    if (kept && kept->identity == record.identity) return kept;
  }
  was_made_ = true;
  const OpenScene scene = first_views(*opened, settings.first_views);
  if (!can_find_depth(scene.scene, settings.options.views)) {
    record.problem = fmt::format("no surface: none of {} views has two neighbors", scene.scene.views.size());
  } else if (auto made = make(scene, settings, record); !made) {
    return std::unexpected(made.error().within(fmt::format("{}, {}", settings.scene, settings.label)));
  }
  QUORUM_TRY(make_folder(folder_ / "runs"));
  QUORUM_TRY(write_file(path, record_json(record)));
  return record;
}

Expected<void> RunMaker::make(const OpenScene& scene, const RunSettings& settings, RunRecord& record) {
  QUORUM_ASSIGN(const Workspace workspace, Workspace::open(folder_ / "work"));
  SilentProgress silent(progress_);
  RunOptions options = settings.options;
  options.saved_maps = SavedMaps::kAll;  // correlation is measured
  QUORUM_TRY(provide_depth_maps({scene.scene, options, backend_, workspace, silent}, scene, record));
  Run run{scene.scene, options, backend_, workspace, silent};
  QUORUM_TRY(reconstruct(run, {.depth_maps = false}));
  record.wall_seconds += run.report.wall_seconds;
  record.cpu_seconds += run.report.cpu_seconds;
  record.peak_memory_bytes = peak_memory_bytes();
  record.voxel_size = run.report.voxel_size;
  record.min_confidence = run.report.min_confidence;
  QUORUM_ASSIGN(const Mesh mesh, read_ply(workspace.mesh_path(), scene.scene.offset));
  if (progress_.stop_requested()) return std::unexpected(stopped());
  QUORUM_ASSIGN(record.mesh, score_mesh(scene, mesh));
  if (progress_.stop_requested()) return std::unexpected(stopped());
  const std::filesystem::path pictures = folder_ / "runs" / run_id(record);
  QUORUM_TRY(make_folder(pictures));
  return write_pictures(scene, options, workspace, mesh, pictures);
}

/// Leaves the depth maps of the run in its workspace. work/depth.json, written last, says what lies there.
Expected<void> RunMaker::provide_depth_maps(Run run, const OpenScene& scene, RunRecord& record) {
  const std::filesystem::path note = run.workspace.folder() / "depth.json";
  const std::string identity = Identity{Json::parse(record.identity).at("depth"), {}}.text();
  if (const auto text = read_file(note); text) {
    auto kept = read_record(*text);
    if (kept && kept->identity == identity) {
      record.depth = kept->depth;
      record.wall_seconds = kept->wall_seconds;
      record.cpu_seconds = record.depth_cpu_seconds = kept->cpu_seconds;
      return {};
    }
  }
  std::error_code ignored;
  std::filesystem::remove(note, ignored);
  std::filesystem::remove_all(run.workspace.folder() / "depth", ignored);
  QUORUM_TRY(make_folder(run.workspace.folder() / "depth"));
  QUORUM_TRY(reconstruct(run, {.certainties = false, .mesh = false}));
  record.wall_seconds = run.report.wall_seconds;
  record.cpu_seconds = record.depth_cpu_seconds = run.report.cpu_seconds;
  QUORUM_ASSIGN(record.depth, measure_depth_maps(scene, run.options, run.workspace, run.report, run.progress));
  RunRecord kept = record;
  kept.identity = identity;
  return write_file(note, record_json(kept));
}

}  // namespace quorum
