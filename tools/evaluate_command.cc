// quorum evaluate: accuracy and completeness against a known surface.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/evaluate/evaluate.h"
#include "engine/io/ply.h"
#include "tools/command.h"

namespace quorum {
namespace {

struct EvaluateArguments {
  std::filesystem::path mesh;
  std::filesystem::path truth;
  std::string threshold = "1.25mm";
  std::vector<std::string> distances = {"0.25mm", "0.5mm", "1.25mm"};
  bool json = false;
  EvaluateOptions options;
};

void print_json(const Evaluation& result, const EvaluateOptions& options) {
  nlohmann::ordered_json scores = nlohmann::ordered_json::array();
  for (const FScore& score : result.f_scores)
    scores.push_back(
        {{"distance", score.distance}, {"precision", score.precision}, {"recall", score.recall}, {"f", score.f}});
  const nlohmann::ordered_json all = {{"share", options.share},
                                      {"accuracy", result.accuracy},
                                      {"median_accuracy", result.median_accuracy},
                                      {"mean_accuracy", result.mean_accuracy},
                                      {"threshold", options.threshold},
                                      {"completeness", result.completeness},
                                      {"f_scores", scores}};
  fmt::print("{}\n", all.dump(2));
}

/// In millimeters, for scenes in meters.
void print_table(const Evaluation& result, const EvaluateOptions& options) {
  fmt::print("accuracy at {:.0f} %     {:.3f} mm   (median {:.3f}, mean {:.3f})\n", options.share * 100,
             result.accuracy * 1e3, result.median_accuracy * 1e3, result.mean_accuracy * 1e3);
  fmt::print("completeness        {:.1f} %      (within {:.3f} mm)\n", result.completeness * 100,
             options.threshold * 1e3);
  for (const FScore& score : result.f_scores)
    fmt::print("at {:.3f} mm         precision {:.3f}, recall {:.3f}, F {:.3f}\n", score.distance * 1e3,
               score.precision, score.recall, score.f);
}

Expected<void> evaluate_files(EvaluateArguments& arguments) {
  const auto threshold = parse_length("--threshold", arguments.threshold);
  if (!threshold) return std::unexpected(threshold.error());
  arguments.options.threshold = *threshold;
  arguments.options.distances.clear();
  for (const std::string& text : arguments.distances) {
    const auto distance = parse_length("--distances", text);
    if (!distance) return std::unexpected(distance.error());
    arguments.options.distances.push_back(*distance);
  }
  if (auto checked = arguments.options.check(); !checked) return checked;
  const auto mesh = read_ply(arguments.mesh);
  if (!mesh) return std::unexpected(mesh.error());
  const auto truth = read_ply(arguments.truth);
  if (!truth) return std::unexpected(truth.error());
  const auto result = evaluate(*mesh, *truth, arguments.options);
  if (!result) return std::unexpected(result.error());
  if (arguments.json)
    print_json(*result, arguments.options);
  else
    print_table(*result, arguments.options);
  return {};
}

}  // namespace

int evaluate_command(int argc, char** argv) {
  CLI::App app("Measure a mesh or cloud against the truth, as Seitz et al. 2006 do.", "evaluate");
  EvaluateArguments arguments;
  app.add_option("mesh", arguments.mesh, "PLY file of the reconstruction")->required();
  app.add_option("truth", arguments.truth, "PLY file of the truth")->required();
  app.add_option("--share", arguments.options.share,
                 "Accuracy: the distance that holds this share of the reconstruction")
      ->capture_default_str();
  app.add_option("--threshold", arguments.threshold, "Completeness: share of the truth within this distance")
      ->capture_default_str();
  app.add_option("--distances", arguments.distances, "Precision, recall and F at these distances")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--samples", arguments.options.samples, "Points taken from each surface")->capture_default_str();
  app.add_flag("--json", arguments.json, "Print JSON, in scene units");
  return run_command(app, argc, argv, [&] { return evaluate_files(arguments); });
}

}  // namespace quorum
