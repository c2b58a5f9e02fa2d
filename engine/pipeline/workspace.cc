#include "engine/pipeline/workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/core/option.h"
#include "engine/io/file.h"
#include "engine/io/pfm.h"
#include "engine/io/preview.h"
#include "engine/io/write_image.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

bool ends_a_name_in(const fs::path& folder, std::string_view ending) {
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    if (entry->path().filename().string().ends_with(ending)) return true;
  return false;
}

/// Whether a run worked here: there is its report, its lock, which a killed one leaves, or what it saved of a view or a
/// shard.
bool is_of_a_run(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / ".quorum.lock", ignored) || ends_a_name_in(folder / "depth", ".depth.json") ||
      ends_a_name_in(folder / "shards", ".json"))
    return true;
  const std::string report = read_file(folder / "run.json").value_or("");
  return report.contains("\"version\"") && report.contains("\"photographs\"");
}

}  // namespace

Expected<void> Workspace::check_ours(const fs::path& folder) {
  if (is_of_a_run(folder)) return {};
  for (const char* name : {"mesh.ply", "fused.ply", "run.json", "report.html"}) {
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(folder / name, ignored)))
      return failure(ErrorKind::kInput,
                     fmt::format("{}: is there already and was not written by quorum; choose another output folder",
                                 (folder / name).string()));
  }
  return {};
}

Expected<Workspace> Workspace::open(const std::filesystem::path& folder) {
  QUORUM_TRY(check_ours(folder));
  QUORUM_TRY(make_folder(folder / "depth"));
  return Workspace(folder);
}

std::filesystem::path Workspace::map_path(const std::string& view, const char* map, const char* kind) const {
  return folder_ / "depth" / fmt::format("{}.{}.{}", view, map, kind);
}

bool Workspace::has_depth_map(const std::string& view) const {
  std::error_code ignored;
  return std::filesystem::is_regular_file(map_path(view, "depth", "json"), ignored) &&
         std::filesystem::is_regular_file(map_path(view, "depth", "pfm"), ignored);
}

std::string Workspace::depth_record(const std::string& view) const {
  return read_file(map_path(view, "depth", "json")).value_or("");
}

std::string Workspace::certainty_record(const std::string& view) const {
  std::error_code code;
  const auto bytes = fs::file_size(map_path(view, "certainty", "pfm"), code);
  if (code || bytes != fs::file_size(map_path(view, "depth", "pfm"), code)) return "";
  return read_file(map_path(view, "certainty", "json")).value_or("");
}

bool Workspace::has_maps(const std::string& view, const SavedFiles& files) const {
  std::error_code code;
  const auto bytes = [&](const char* map) { return fs::file_size(map_path(view, map, "pfm"), code); };
  const auto depth = bytes("depth");
  if (code) return false;
  const auto fits = [&](const char* map) { return bytes(map) == depth && !code; };  // the same size and header
  return (!files.correlation || fits("correlation")) && (!files.confidence || fits("confidence")) &&
         (!files.normals || (bytes("normal") > 2 * depth && !code));
}

template <typename Color, typename Value>
Expected<void> Workspace::add_preview(const std::string& view, const char* map, const Grid<Value>& values,
                                      Previews previews, const Color& color, FileGroup& group) const {
  const std::filesystem::path path = map_path(view, map, "png");
  if (previews == Previews::kNone) {
    remove_file(path);
    return {};
  }
  const auto bytes = encode_png(color(previews == Previews::kSmall ? thin_out(values, kSmallPreview) : values));
  if (!bytes) return std::unexpected(bytes.error().within(path.string()));
  return group.add(path, *bytes);
}

Expected<void> Workspace::save_depth_map(const std::string& view, const DepthMap& map, std::string_view record,
                                         const SavedFiles& files) const {
  remove_file(map_path(view, "depth", "json"));
  FileGroup group;
  const auto add = [&](const char* name, const auto& values, bool wanted, const auto& color) -> Expected<void> {
    const std::filesystem::path path = map_path(view, name, "pfm");
    if (wanted && !values.empty()) {
      QUORUM_TRY(add_preview(view, name, values, files.previews, color, group));
      return group.add(path, pfm_bytes(values));
    }
    remove_file(path);
    remove_file(map_path(view, name, "png"));
    return {};
  };
  QUORUM_TRY(add("correlation", map.correlation, files.correlation, color_map_unit));
  QUORUM_TRY(add("confidence", map.confidence, files.confidence, color_map_unit));
  QUORUM_TRY(add("normal", map.normal, files.normals, color_map_normal));
  QUORUM_TRY(add("depth", map.depth, true, color_map_depth));
  QUORUM_TRY(group.add(map_path(view, "depth", "json"), record));
  return group.finish();
}

template <typename Value>
Expected<Grid<Value>> Workspace::fitting(const std::string& view, const char* map, int width, int height,
                                         Expected<Grid<Value>> loaded) const {
  if (!loaded && loaded.error().kind == ErrorKind::kInput)
    return failure(ErrorKind::kInput, loaded.error().message + "; run `quorum depth` on this scene again");
  if (loaded && (loaded->width != width || loaded->height != height))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: is {} x {}, but the view is {} x {}; run `quorum depth` on this scene again",
                               map_path(view, map, "pfm").string(), loaded->width, loaded->height, width, height));
  return loaded;
}

Expected<std::filesystem::path> Workspace::find_map(const std::string& view, const char* map) const {
  std::filesystem::path path = map_path(view, map, "pfm");
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    return failure(ErrorKind::kInput, fmt::format("{}: is missing; run `quorum depth` on this scene again, with {} all",
                                                  path.string(), option_name("maps")));
  return path;
}

Expected<Grid<float>> Workspace::load_map(const std::string& view, const char* map, int width, int height) const {
  QUORUM_ASSIGN(const auto path, find_map(view, map));
  auto loaded = fitting(view, map, width, height, read_pfm(path));
  if (!loaded) return loaded;
  const auto is_odd = [](float value) { return !(value >= 0.0F && value <= std::numeric_limits<float>::max()); };
  const auto odd = std::ranges::find_if(loaded->values, is_odd);
  if (odd == loaded->values.end()) return loaded;
  const auto pixel = static_cast<int>(odd - loaded->values.begin());
  return failure(ErrorKind::kInput,
                 fmt::format("{}: holds {} at pixel ({}, {}), which no run writes; make it anew with {}", path.string(),
                             *odd, pixel % width, pixel / width, option_name("restart")));
}

Expected<Grid<Eigen::Vector3f>> Workspace::load_normals(const std::string& view, int width, int height) const {
  QUORUM_ASSIGN(const auto path, find_map(view, "normal"));
  return fitting(view, "normal", width, height, read_pfm_vectors(path));
}

Expected<DepthMap> Workspace::load_depth_map(const std::string& view, int width, int height) const {
  DepthMap map;
  const auto load = [&](const char* name, Grid<float>& grid) -> Expected<void> {
    QUORUM_ASSIGN(auto loaded, load_map(view, name, width, height));
    grid = std::move(loaded);
    return {};
  };
  for (const auto& result :
       {load("depth", map.depth), load("correlation", map.correlation), load("confidence", map.confidence)})
    if (!result) return std::unexpected(result.error());
  return map;
}

Expected<DepthMap> Workspace::load_weighed_depth(const std::string& view, int width, int height,
                                                 bool with_certainty) const {
  DepthMap map;
  QUORUM_ASSIGN(map.depth, load_map(view, "depth", width, height));
  QUORUM_ASSIGN(map.confidence, load_map(view, with_certainty ? "certainty" : "confidence", width, height));
  return map;
}

Expected<Grid<float>> Workspace::load_depth(const std::string& view, int width, int height) const {
  return load_map(view, "depth", width, height);
}

Expected<void> Workspace::save_certainty(const std::string& view, const Grid<float>& certainty, std::string_view record,
                                         Previews previews) const {
  remove_file(map_path(view, "certainty", "json"));
  FileGroup group;
  QUORUM_TRY(add_preview(view, "certainty", certainty, previews, color_map_unit, group));
  QUORUM_TRY(group.add(map_path(view, "certainty", "pfm"), pfm_bytes(certainty)));
  QUORUM_TRY(group.add(map_path(view, "certainty", "json"), record));
  return group.finish();
}

Expected<Grid<float>> Workspace::load_certainty(const std::string& view, int width, int height) const {
  return load_map(view, "certainty", width, height);
}

void Workspace::remove_certainty(const std::string& view) const {
  std::error_code ignored;
  remove_file(map_path(view, "certainty", "json"));
  for (const char* kind : {"pfm", "png"}) std::filesystem::remove(map_path(view, "certainty", kind), ignored);
}

void Workspace::remove_depth_map(const std::string& view) const {
  std::error_code ignored;
  remove_certainty(view);
  remove_file(map_path(view, "depth", "json"));
  for (const char* map : {"depth", "correlation", "confidence", "normal"})
    for (const char* kind : {"pfm", "png"}) std::filesystem::remove(map_path(view, map, kind), ignored);
}

std::filesystem::path Workspace::shard_path(std::string_view stage, const Shard& shard, std::string_view kind) const {
  return folder_ / "shards" / fmt::format("{}-{}-of-{}.{}", stage, shard.index + 1, shard.count, kind);
}

std::vector<Shard> Workspace::find_shards(std::string_view stage, std::string_view kind) const {
  std::vector<Shard> found;
  std::error_code code;
  for (std::filesystem::directory_iterator entry(folder_ / "shards", code), end; !code && entry != end;
       entry.increment(code)) {
    const std::string name = entry->path().filename().string();
    const std::size_t number = stage.size() + 1;
    const std::size_t of = name.find("-of-", number);
    const std::size_t dot = name.find('.', number);
    if (!name.starts_with(stage) || of == std::string::npos || dot == std::string::npos || dot < of) continue;
    const auto shard = parse_shard(name.substr(number, of - number) + "/" + name.substr(of + 4, dot - of - 4));
    if (shard && entry->path() == shard_path(stage, *shard, kind)) found.push_back(*shard);
  }
  std::ranges::sort(found, {}, [](const Shard& shard) { return std::pair(shard.count, shard.index); });
  return found;
}

void Workspace::remove_shards(std::string_view stage) const {
  for (const char* kind : {"json", "part"})
    for (const Shard& shard : find_shards(stage, kind)) remove_file(shard_path(stage, shard, kind));
}

void Workspace::remove_report() const {
  remove_file(report_path());
  remove_file(verified_path());
}

}  // namespace quorum
