#include "engine/conformance/verify_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/version.h"
#include "engine/io/file.h"
#include "engine/pipeline/run_json.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Lays what differs from the defaults over the options.
Expected<void> lay_over(RunOptions& options, const RunOptions& given, RunStage stage) {
  const RunOptions defaults;
  for (const RunOption& option : run_option_table()) {
    const std::string text = option.text(given);
    if (option.stage != stage || option.most_words > 1 || text.empty() || text == option.text(defaults)) continue;
    QUORUM_TRY(option.parse(options, {text}));
  }
  return {};
}

/// Compares what is called so in both folders.
Expected<void> compare_file(const fs::path& name, const Workspace& one, const Workspace& other, std::string_view stage,
                            RunComparison& result) {
  const bool is_in_one = fs::exists(one.folder() / name);
  const bool is_in_other = fs::exists(other.folder() / name);
  if (!result.stage.empty() || (!is_in_one && !is_in_other)) return {};
  ++result.files;
  bool differs = is_in_one != is_in_other;
  if (!differs) {
    QUORUM_ASSIGN(const auto bytes, read_file(one.folder() / name));
    QUORUM_ASSIGN(const auto other_bytes, read_file(other.folder() / name));
    differs = bytes != other_bytes;
  }
  if (!differs) return {};
  result.stage = stage;
  result.different = name.string();
  return {};
}

}  // namespace

Expected<RunOptions> options_of_run(const Workspace& workspace, const RunOptions& given) {
  const auto text = read_file(workspace.report_path());
  const Json run = text ? Json::parse(*text, nullptr, false) : Json();
  if (!run.is_object() || !run.contains("options"))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: no finished run is here; run quorum reconstruct to its end first",
                               workspace.report_path().string()));
  if (const Json made_by = run.value("version", Json()); made_by != Json(version()))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: the run was made by Quorum {}, this is {}; verify it with that one",
                               workspace.report_path().string(), made_by.dump(), version()));
  RunOptions options;
  if (auto taken = take_options(options, run["options"].dump(), RunStage::kScene, RunStage::kClean); !taken)
    return failure(ErrorKind::kInput, taken.error().within(workspace.report_path().string()).message);
  for (const RunStage stage : {RunStage::kNone, RunStage::kScene}) QUORUM_TRY(lay_over(options, given, stage));
  options.previews = Previews::kNone;
  options.saved_maps = SavedMaps::kAll;
  return options;
}

Expected<RunComparison> compare_runs(const Scene& scene, const Workspace& one, const Workspace& other) {
  RunComparison result;
  const auto compare = [&](const char* stage, std::initializer_list<const char*> kinds, bool saved) -> Expected<void> {
    for (const View& view : scene.views)
      for (const char* kind : kinds) {
        const fs::path name = fs::path("depth") / (view.name + kind);
        // A run may have been asked to save fewer maps.
        if (saved && !fs::exists(one.folder() / name)) continue;
        QUORUM_TRY(compare_file(name, one, other, stage, result));
      }
    return {};
  };
  QUORUM_TRY(compare("photographs, cameras and options", {".depth.json"}, false));
  QUORUM_TRY(compare("depth maps", {".depth.pfm"}, false));
  QUORUM_TRY(compare("depth maps", {".correlation.pfm", ".confidence.pfm", ".normal.pfm"}, true));
  QUORUM_TRY(compare("certainties", {".certainty.pfm"}, false));
  QUORUM_TRY(compare_file("mesh.ply", one, other, "mesh", result));
  return result;
}

Expected<void> record_verified(const Workspace& workspace, std::string_view device) {
  const fs::path path = workspace.verified_path();
  const auto old = read_file(path);
  Json record = old ? Json::parse(*old, nullptr, false) : Json::object();
  if (old && !(record.is_object() && record["version"].is_string()))
    return failure(ErrorKind::kInput, path.string() + ": is there already and was not written by quorum; rename it");
  if (record.value("version", "") != version() || !record["devices"].is_array())
    record = {{"version", version()}, {"devices", Json::array()}};
  Json& devices = record["devices"];
  if (std::ranges::find(devices, Json(device)) == devices.end()) devices.push_back(device);
  return write_file(path, record.dump(2) + "\n");
}

}  // namespace quorum
