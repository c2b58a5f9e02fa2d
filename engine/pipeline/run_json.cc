#include "engine/pipeline/run_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/core/printable.h"
#include "engine/core/version.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

/// The value of an option: a number, true or false, a list, or text.
Json value_of(const RunOption& option, const std::string& text) {
  if (option.is_list) {
    Json parts = Json::array();
    for (std::size_t begin = 0, end = 0; text != "none" && end != std::string::npos; begin = end + 1) {
      end = text.find(',', begin);
      parts.push_back(text.substr(begin, end - begin));
    }
    return parts;
  }
  Json value = Json::parse(text, nullptr, false);
  return value.is_number() || value.is_boolean() ? value : Json(text);
}

/// An option's value as it would be typed.
std::string text_of(const Json& value) {
  if (!value.is_array()) return value.is_string() ? value.get<std::string>() : value.dump();
  std::string list;
  for (const Json& part : value) list += (list.empty() ? "" : ",") + text_of(part);
  return list.empty() ? "none" : list;
}

std::string key_of(const RunOption& option) {
  std::string key = option.name;
  std::ranges::replace(key, '-', '_');
  return key;
}

/// The words of an option as it would be typed.
std::vector<std::string> words_of(const RunOption& option, const std::string& text) {
  if (option.most_words <= 1) return {text};
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

Json json_of(const RunOptions& options, RunStage first, RunStage last) {
  Json json = Json::object();
  for (const RunOption& option : run_option_table()) {
    const std::string text = option.text(options);
    if (option.stage < first || option.stage > last || text.empty()) continue;
    json[key_of(option)] = value_of(option, text);
  }
  return json;
}

}  // namespace

std::string options_json(const RunOptions& options, RunStage first, RunStage last) {
  return json_of(options, first, last).dump(2) + "\n";
}

Expected<void> take_options(RunOptions& options, const std::string& json, RunStage first, RunStage last) {
  const RunOptions defaults;
  const Json given = Json::parse(json, nullptr, false);
  for (const RunOption& option : run_option_table()) {
    const std::string key = key_of(option);
    if (option.stage < first || option.stage > last || !given.is_object() || !given.contains(key)) continue;
    const std::string text = text_of(given[key]);
    if (option.most_words == 0 && text == option.text(defaults)) continue;
    QUORUM_TRY(option.parse(options, words_of(option, text)));
  }
  return options.check();
}

std::string run_json(const Run& run) {
  const RunReport& report = run.report;
  Json stages = Json::array();
  for (const StageReport& stage : report.stages)
    stages.push_back({{"name", stage.name}, {"wall_seconds", stage.wall_seconds}, {"cpu_seconds", stage.cpu_seconds}});
  Json kernels = Json::array();
  for (const StageTime& kernel : report.kernels)
    kernels.push_back({{"name", kernel.name}, {"seconds", kernel.seconds}});
  Json views = Json::array();
  for (const ViewReport& view : report.views)
    views.push_back({{"name", view.name},
                     {"neighbors", view.neighbors},
                     {"swept_pixels", view.swept_pixels},
                     {"depth_samples", view.depth_samples},
                     {"valid_pixels", view.valid_pixels}});
  Json photographs = Json::object();  // what the scene's files call the photographs of views
  for (const View& view : run.scene.views) photographs[view.name] = printable(view.image_name);
  const auto point = [](const Eigen::Vector3d& p) { return Json{p.x(), p.y(), p.z()}; };
  const Eigen::Vector3d& offset = run.scene.offset;
  const Json all = {{"version", version()},
                    {"device", report.device},
                    {"scene",
                     {{"views", run.scene.views.size()},
                      {"bounds", {point(run.scene.bounds.low + offset), point(run.scene.bounds.high + offset)}},
                      {"offset", point(offset)},
                      {"notes", run.scene.notes},
                      {"photographs", photographs}}},
                    {"options", json_of(run.options, RunStage::kScene, RunStage::kExtras)},
                    {"wall_seconds", report.wall_seconds},
                    {"cpu_seconds", report.cpu_seconds},
                    {"stages", stages},
                    {"kernels", kernels},
                    {"work",
                     {{"sweep_windows", report.sweep.sweep_windows},
                      {"sweep_samples", report.sweep.sweep_samples},
                      {"refine_windows", report.sweep.refine_windows},
                      {"refine_samples", report.sweep.refine_samples}}},
                    {"device_work",
                     {{"uploaded_bytes", report.device_work.uploaded_bytes},
                      {"downloaded_bytes", report.device_work.downloaded_bytes},
                      {"submissions", report.device_work.submissions},
                      {"dispatches", report.device_work.dispatches},
                      {"allocations", report.device_work.allocations},
                      {"waited_seconds", report.device_work.waited_seconds}}},
                    {"memory_budget_bytes", report.memory_budget_bytes},
                    {"estimated_memory_bytes", report.estimated_memory_bytes},
                    {"peak_memory_bytes", report.peak_memory_bytes},
                    {"volume",
                     {{"voxel_size", report.voxel_size},
                      {"truncation", report.truncation},
                      {"blocks", report.blocks},
                      {"block_views", report.block_views},
                      {"slabs", report.slabs}}},
                    {"mesh",
                     {{"min_confidence", report.min_confidence},
                      {"extracted_triangles", report.extracted_triangles},
                      {"triangles", report.triangles},
                      {"vertices", report.vertices},
                      {"pieces", report.pieces},
                      {"filled_vertices", report.filled_vertices}}},
                    {"kept_depth_maps", report.kept_depth_maps},
                    {"kept_certainties", report.kept_certainties},
                    {"compared_depths", report.compared_depths},
                    {"confirmed_depths", report.confirmed_depths},
                    {"depth_maps", views}};
  return all.dump(2) + "\n";
}

}  // namespace quorum
