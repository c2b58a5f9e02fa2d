#include "engine/pipeline/provenance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/io/sha256.h"
#include "engine/pipeline/run_json.h"
#include "engine/pipeline/stage_versions.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRemedy = "run `quorum depth` on this scene again";

std::string camera_digest(const View& view) {
  Sha256 hash;
  const auto add_camera = [&hash](const Camera& camera) {
    hash.add_values(camera.intrinsics.data(), 9);
    hash.add_values(camera.camera_from_world.data(), 9);
    hash.add_values(camera.translation.data(), 3);
  };
  add_camera(view.camera);
  const std::array sizes = {view.width, view.height, view.photo_width, view.photo_height, view.halvings};
  hash.add_values(sizes.data(), sizes.size());
  if (view.lens) {
    const Lens& lens = *view.lens;
    const std::array shape = {static_cast<int>(lens.model), lens.width, lens.height};
    hash.add_values(shape.data(), shape.size());
    hash.add_values(lens.focal.data(), 2);
    hash.add_values(lens.principal.data(), 2);
    hash.add_values(lens.coefficients.data(), lens.coefficients.size());
  }
  return hash.hex();
}

Json options_of(const Run& run, RunStage first, RunStage last) {
  return Json::parse(options_json(run.options, first, last));
}
Json options_of(const Run& run, RunStage stage) { return options_of(run, stage, stage); }

Json point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// Without what is nested deeper than any record of ours.
Json parse_record(const std::string& text) {
  constexpr int kDeepest = 8;
  Json record = Json::parse(
      text, [](int depth, Json::parse_event_t, const Json&) { return depth < kDeepest; }, false);
  return record.is_object() ? record : Json::object();
}

/// The first member in which two objects differ, as "window 9"; empty if they don't. other: its value there.
std::string difference(const Json& one, const Json& two, std::string& other) {
  for (const auto& [key, value] : one.items())
    if (const auto found = two.find(key); found == two.end() || *found != value) {
      other = found == two.end() ? "none" : found->dump();
      return fmt::format("{} {}", key, value.dump());
    }
  return one.size() == two.size() ? "" : "other options";
}

}  // namespace

Expected<std::string> Provenance::digest_of(const std::filesystem::path& path) {
  if (path.empty()) return std::string();
  if (const auto known = files_.find(path); known != files_.end()) return known->second;
  std::ifstream file(path, std::ios::binary);
  Sha256 hash;
  std::string piece(1 << 18, '\0');
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
    hash.add({piece.data(), static_cast<std::size_t>(file.gcount())});
  if (!file.eof())
    return failure(ErrorKind::kInput, fmt::format("{}: cannot be read; check the path and the disk", path.string()));
  return files_.emplace(path, hash.hex()).first->second;
}

Expected<std::string> Provenance::depth_record(int index, const std::vector<int>& neighbors) {
  const View& view = run_.view(index);
  const Bounds& bounds = run_.scene.bounds;
  QUORUM_ASSIGN(const auto image, digest_of(view.image_path));
  QUORUM_ASSIGN(const auto mask, digest_of(view.mask_path));
  Json compared = Json::array();
  for (const int neighbor : neighbors) {
    const View& other = run_.view(neighbor);
    QUORUM_ASSIGN(const auto other_image, digest_of(other.image_path));
    compared.push_back({{"name", other.name}, {"image", other_image}, {"camera", camera_digest(other)}});
  }
  const Json record = {{"version", kDepthVersion},
                       {"options", options_of(run_, RunStage::kDepth)},
                       {"bounds", {point(bounds.low), point(bounds.high)}},
                       {"depths", {view.near_depth, view.far_depth}},
                       {"image", image},
                       {"mask", mask},
                       {"camera", camera_digest(view)},
                       {"neighbors", compared}};
  return record.dump(2) + "\n";
}

const std::string& Provenance::digest_of_record(int view) {
  const auto [place, is_new] = records_.try_emplace(view);
  if (const std::string text = is_new ? run_.workspace.depth_record(run_.view(view).name) : ""; !text.empty())
    place->second = sha256(text);
  return place->second;
}

std::string Provenance::certainty_record(int view, const std::vector<int>& others, const std::vector<int>& reach) {
  if (digest_of_record(view).empty()) return "";
  Json compared = Json::array();
  for (const int other : others)
    compared.push_back({{"name", run_.view(other).name}, {"depth_map", digest_of_record(other)}});
  Sha256 further;
  for (const int other : reach) further.add(run_.view(other).name + "\n" + digest_of_record(other) + "\n");
  const Json record = {{"version", kFusionVersion},
                       {"options", options_of(run_, RunStage::kConfirm)},
                       {"depth_map", digest_of_record(view)},
                       {"others", compared},
                       {"all", further.hex()}};
  return record.dump(2) + "\n";
}

std::string Provenance::surface_record(const std::vector<int>& views, const VoxelGrid& grid, const Shard& shard) {
  Sha256 hash;
  for (const int view : views) {
    const std::string& name = run_.view(view).name;
    hash.add(name + "\n" + digest_of_record(view) + "\n");
    if (run_.options.confirm) hash.add(sha256(run_.workspace.certainty_record(name)) + "\n");
  }
  Json record = {{"version", kFusionVersion},
                 {"options", options_of(run_, RunStage::kConfirm, RunStage::kFusion)},
                 {"grid",
                  {{"origin", point(grid.origin)},
                   {"voxel_size", grid.voxel_size},
                   {"truncation", grid.truncation},
                   {"blocks", grid.blocks}}},
                 {"depth_maps", hash.hex()},
                 {"shard", shard.text()}};
  if (run_.options.fusion.fill_holes) record["mask_below"] = run_.options.mask_below;
  return record.dump(2) + "\n";
}

Expected<void> Provenance::check_depth_maps(const std::vector<int>& views) {
  std::map<std::string, int> index_of;
  for (int index = 0; index < static_cast<int>(run_.scene.views.size()); ++index)
    index_of.emplace(run_.view(index).name, index);
  Json first;
  std::string first_name;
  for (const int view : views) {
    const std::string& name = run_.view(view).name;
    const auto refuse = [&](const std::string& what) {
      return failure(ErrorKind::kInput, fmt::format("{}: the depth map of {} {}; {}", run_.workspace.folder().string(),
                                                    name, what, kRemedy));
    };
    const Json record = parse_record(run_.workspace.depth_record(name));
    const Json none;
    const auto member = [](const Json& json, const char* key) { return json.value(key, Json()); };
    if (!record.contains("options") || !member(record, "neighbors").is_array())
      return refuse("does not say what it was made from");
    if (member(record, "version") != kDepthVersion) return refuse("was made by another version of Quorum");
    if (first.is_null()) {
      first = record;
      first_name = name;
    }
    std::string other;
    if (const auto odd = difference(member(record, "options"), member(first, "options"), other); !odd.empty())
      return refuse(fmt::format("was made with {}, that of {} with {}", odd, first_name, other));
    if (member(record, "bounds") != member(first, "bounds"))
      return refuse(fmt::format("was made in another box than that of {}", first_name));
    std::vector<int> neighbors;
    for (const Json& neighbor : record["neighbors"]) {
      const Json label = neighbor.is_object() ? member(neighbor, "name") : Json();
      const auto known = label.is_string() ? index_of.find(label.get<std::string>()) : index_of.end();
      if (known == index_of.end()) return refuse("was compared with a view that this scene does not have");
      neighbors.push_back(known->second);
    }
    if (run_.options.shard && !run_.options.shard->has(view)) continue;
    QUORUM_ASSIGN(const auto text, depth_record(view, neighbors));
    const Json expected = Json::parse(text);
    for (const auto& [key, what] : {std::pair{"image", "another photograph"},
                                    {"mask", "another mask"},
                                    {"camera", "another camera or another size"}})
      if (member(record, key) != expected[key]) return refuse(fmt::format("was made with {}", what));
    if (record["neighbors"] != expected["neighbors"])
      return refuse("was made with other photographs or cameras of its neighbors");
  }
  return {};
}

Expected<void> take_depth_options(RunOptions& options, const Scene& scene, const Workspace& workspace) {
  for (const View& view : scene.views) {
    const Json record = parse_record(workspace.depth_record(view.name));
    Json given = record.value("options", Json());
    if (!given.is_object()) continue;
    given.erase("mask_below");  // which a later stage may set anew
    return take_options(options, given.dump(), RunStage::kDepth, RunStage::kDepth);
  }
  return {};
}

Expected<void> take_surface_options(RunOptions& options, const std::string& record) {
  const Json all = parse_record(record);
  if (const Json level = all.value("mask_below", Json()); level.is_number()) options.mask_below = level;
  const Json given = all.value("options", Json());
  return given.is_object() ? take_options(options, given.dump(), RunStage::kConfirm, RunStage::kFusion)
                           : Expected<void>();
}

}  // namespace quorum
