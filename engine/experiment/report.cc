#include "engine/experiment/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/core/version.h"
#include "engine/pipeline/run_json.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

double share(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::string percent(double value) { return fmt::format("{:.1f}", 100.0 * value); }

std::string millimeters(double meters) { return fmt::format("{:.3f}", 1e3 * meters); }

/// The cells of a run's row, in the order of the header.
std::vector<std::string> cells(const RunSettings& settings, const RunRecord& record) {
  const DepthMeasures& depth = record.depth;
  std::vector<std::string> row = {settings.scene,
                                  settings.label,
                                  fmt::format("{}", depth.views),
                                  percent(share(depth.valid_pixels, depth.swept_pixels)),
                                  percent(share(depth.loose_pixels, depth.valid_pixels)),
                                  percent(share(depth.background_pixels, depth.valid_pixels)),
                                  fmt::format("{:.2f}", depth.roughness),
                                  depth.median_error ? millimeters(*depth.median_error) : "",
                                  depth.wrong_share ? percent(*depth.wrong_share) : "",
                                  fmt::format("{}", record.mesh.vertices)};
  if (const auto& evaluation = record.mesh.evaluation) {
    row.push_back(millimeters(evaluation->accuracy));
    row.push_back(millimeters(evaluation->median_accuracy));
    row.push_back(percent(evaluation->completeness));
    row.push_back(evaluation->f_scores.size() > 1 ? fmt::format("{:.3f}", evaluation->f_scores[1].f) : "");
  } else {
    row.insert(row.end(), 4, "");
  }
  row.push_back(fmt::format("{:.1f}", record.cpu_seconds));
  row.push_back(fmt::format("{:.1f}", record.wall_seconds));
  return row;
}

constexpr const char* kColumns[] = {
    "scene",           "settings",        "depth maps",      "coverage, %", "loose, %",          "background, %",
    "roughness",       "depth error, mm", "wrong depths, %", "vertices",    "accuracy 90 %, mm", "50 %, mm",
    "completeness, %", "F at 0.5 mm",     "CPU s",           "wall s"};

constexpr const char* kLegend = R"(
- Coverage: share of the pixels whose ray meets the bounds, and that no mask leaves out, that have a depth.
- Loose: share of these depths that form no triangle and are dropped. Background: share of them where the photograph
  shows its dark background.
- Roughness: median of the second difference of depth along rows, in footprints of a pixel.
- Depth error: median distance of the depths from the true surface; wrong: further than 1.25 mm.
- Accuracy, completeness (within 1.25 mm) and F of the mesh as in Seitz et al. 2006, where the true surface is known.
- Times are of the run alone, without the measuring.
)";

/// The head of a table.
std::string header() {
  std::string rule = "|";
  for (std::size_t column = 0; column < std::size(kColumns); ++column) rule += "---|";
  return fmt::format("| {} |\n{}\n", fmt::join(kColumns, " | "), rule);
}

}  // namespace

std::string results_json(const std::vector<ExperimentResult>& results) {
  Json all = {{"version", version()}, {"experiments", Json::array()}};
  for (const ExperimentResult& result : results) {
    Json runs = Json::array();
    for (const RunResult& run : result.runs) {
      const RunSettings& settings = result.experiment->runs[run.run];
      Json json = {{"label", settings.label},
                   {"first_views", settings.first_views},
                   {"options", Json::parse(options_json(settings.options, RunStage::kScene, RunStage::kExtras))}};
      Json record = Json::parse(record_json(run.record));
      record.erase("identity");
      json.update(record);
      runs.push_back(std::move(json));
    }
    all["experiments"].push_back({{"name", result.experiment->name},
                                  {"question", result.experiment->question},
                                  {"figures", result.figures},
                                  {"runs", std::move(runs)}});
  }
  return all.dump(2) + "\n";
}

std::string results_markdown(const std::vector<ExperimentResult>& results) {
  std::string text = fmt::format("# Experiments after section 4 of the paper\n\nQuorum {}", version());
  if (!results.empty() && !results.front().runs.empty())
    text += fmt::format(", on {}", results.front().runs.front().record.device);
  text += fmt::format(".\n{}", kLegend);
  for (const ExperimentResult& result : results) {
    text += fmt::format("\n## {}\n\n{}.\n\n{}", result.experiment->name, result.experiment->question, header());
    for (const RunResult& run : result.runs) {
      const RunSettings& settings = result.experiment->runs[run.run];
      if (run.record.problem.empty())
        text += fmt::format("| {} |\n", fmt::join(cells(settings, run.record), " | "));
      else
        text += fmt::format("| {} | {}: {} |{}\n", settings.scene, settings.label, run.record.problem,
                            std::string(std::size(kColumns) - 2, '|'));
    }
    for (const std::string& figure : result.figures) text += fmt::format("\n![{}](figures/{}.png)\n", figure, figure);
  }
  return text;
}

std::string result_line(const RunSettings& settings, const RunRecord& record) {
  std::string line = fmt::format("{}, {}: ", settings.scene, settings.label);
  if (!record.problem.empty()) return line + record.problem;
  line += fmt::format("coverage {} %, {} vertices",
                      percent(share(record.depth.valid_pixels, record.depth.swept_pixels)), record.mesh.vertices);
  if (const auto& evaluation = record.mesh.evaluation)
    line += fmt::format(", accuracy {} mm, completeness {} %", millimeters(evaluation->accuracy),
                        percent(evaluation->completeness));
  return line + fmt::format(", {:.1f} CPU s", record.cpu_seconds);
}

}  // namespace quorum
