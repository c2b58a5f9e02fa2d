// quorum evaluate: accuracy and completeness against a known surface.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/core/option_maker.h"
#include "engine/experiment/missed_truth.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "tools/add_options.h"
#include "tools/messages.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

struct EvaluateArguments {
  std::filesystem::path mesh;
  std::filesystem::path truth;
  std::filesystem::path scene;
  std::filesystem::path workspace;
  std::filesystem::path uncleaned;
  bool json = false;
  RunOptions run;
  EvaluateOptions options;
};

/// What is measured; causes only where they were asked for.
struct Measured {
  Evaluation evaluation;
  std::optional<MissedTruth> missed;
};

void print_json(const Measured& measured, const EvaluateArguments& arguments) {
  const Evaluation& result = measured.evaluation;
  const EvaluateOptions& options = arguments.options;
  Json scores = Json::array();
  for (const FScore& score : result.f_scores)
    scores.push_back(
        {{"distance", score.distance}, {"precision", score.precision}, {"recall", score.recall}, {"f", score.f}});
  Json all = {{"share", options.share},
              {"accuracy", result.accuracy},
              {"median_accuracy", result.median_accuracy},
              {"mean_accuracy", result.mean_accuracy},
              {"cap", options.cap},
              {"threshold", options.threshold},
              {"completeness", result.completeness},
              {"seen_by", arguments.scene.empty() ? 0 : options.seen_by},
              {"seen_share", result.seen_share},
              {"components", result.components},
              {"vertices", result.vertices},
              {"far_vertices", result.far_vertices},
              {"f_scores", scores}};
  if (const auto& missed = measured.missed)
    all["missed"] = {{"samples", missed->samples},
                     {"never_depth", missed->never_depth},
                     {"wrong_depth", missed->wrong_depth},
                     {"in_fusion", missed->in_fusion},
                     {"in_clean_up", missed->in_clean_up}};
  print("{}\n", all.dump(2));
}

void print_missed(const MissedTruth& missed, bool knows_uncleaned) {
  const auto percent = [&](std::uint64_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(missed.samples);
  };
  print("missed              {:.2f} %     (never a depth {:.2f}, wrong depth {:.2f}, ", percent(missed.missed()),
        percent(missed.never_depth), percent(missed.wrong_depth));
  if (knows_uncleaned)
    print("lost in fusion {:.2f}, in clean-up {:.2f})\n", percent(missed.in_fusion), percent(missed.in_clean_up));
  else
    print("lost in fusion or clean-up {:.2f})\n", percent(missed.in_clean_up));
}

/// In millimeters, for scenes in meters.
void print_table(const Measured& measured, const EvaluateArguments& arguments) {
  const Evaluation& result = measured.evaluation;
  const EvaluateOptions& options = arguments.options;
  print("accuracy at {:.0f} %     {:.3f} mm   (median {:.3f}, mean {:.3f})\n", options.share * 100,
        result.accuracy * 1e3, result.median_accuracy * 1e3, result.mean_accuracy * 1e3);
  print("completeness        {:.1f} %      (within {:.3f} mm)\n", result.completeness * 100, options.threshold * 1e3);
  for (const FScore& score : result.f_scores)
    print("at {:.3f} mm         precision {:.3f}, recall {:.3f}, F {:.3f}\n", score.distance * 1e3, score.precision,
          score.recall, score.f);
  print("pieces              {}   (of {} vertices {} are further than {:.3f} mm from the truth)\n", result.components,
        result.vertices, result.far_vertices, options.threshold * 1e3);
  if (!arguments.scene.empty() && options.seen_by > 0)
    print("counted             {:.1f} % of the truth, which {} views or more see\n", result.seen_share * 100,
          options.seen_by);
  if (measured.missed) print_missed(*measured.missed, !arguments.uncleaned.empty());
}

/// Causes need the scene and its depth maps.
Expected<std::optional<MissedTruth>> find_missed(const EvaluateArguments& arguments, const Scene& scene,
                                                 const Mesh& mesh, const Mesh& truth) {
  if (arguments.workspace.empty()) return std::nullopt;
  std::optional<Mesh> uncleaned;
  if (!arguments.uncleaned.empty()) {
    QUORUM_ASSIGN(uncleaned, read_ply(arguments.uncleaned, mesh.offset));
  }
  const Workspace workspace = Workspace::at(arguments.workspace);
  return find_missed_truth(scene, workspace, mesh, uncleaned ? &*uncleaned : nullptr, truth, arguments.options);
}

Expected<void> evaluate_files(EvaluateArguments& arguments) {
  QUORUM_TRY(arguments.options.check());
  if (arguments.scene.empty() && !arguments.workspace.empty())
    return failure(ErrorKind::kUsage, "--workspace: what was missed is found with --scene FOLDER alone");
  if (arguments.workspace.empty() && !arguments.uncleaned.empty())
    return failure(ErrorKind::kUsage, "--uncleaned: what was missed is found with --workspace FOLDER alone");
  Scene scene;
  if (!arguments.scene.empty()) {
    QUORUM_ASSIGN(scene, read_scene(arguments.scene, arguments.run.files));
  }
  const auto offset = arguments.scene.empty() ? std::optional<Eigen::Vector3d>() : scene.offset;
  QUORUM_ASSIGN(const auto mesh, read_ply(arguments.mesh, offset));
  QUORUM_ASSIGN(const auto truth, read_ply(arguments.truth, mesh.offset));
  Measured measured;
  QUORUM_ASSIGN(measured.evaluation,
                evaluate(mesh, truth, arguments.options, arguments.scene.empty() ? nullptr : &scene));
  QUORUM_ASSIGN(measured.missed, find_missed(arguments, scene, mesh, truth));
  if (arguments.json)
    print_json(measured, arguments);
  else
    print_table(measured, arguments);
  return {};
}

}  // namespace

int evaluate_command(int argc, char** argv) {
  CommandLine line("Measure a mesh or cloud against the truth, as Seitz et al. 2006 do.", "evaluate");
  EvaluateArguments arguments;
  line.add("mesh", arguments.mesh, "PLY file of the reconstruction").required();
  line.add("truth", arguments.truth, "PLY file of the truth").required();
  using Make = OptionMaker<EvaluateOptions>;
  for (const Option<EvaluateOptions>& option :
       {Make::number("share", QUORUM_MEMBER(share), {0, 1},
                     "Accuracy: the distance that holds this share of the reconstruction"),
        Make::length("threshold", QUORUM_MEMBER(threshold), "Completeness: share of the truth within this distance"),
        Make::lengths("distances", QUORUM_MEMBER(distances), "Precision, recall and F at these distances"),
        Make::length("cap", QUORUM_MEMBER(cap), "The mean counts distances up to this"),
        Make::number("samples", QUORUM_MEMBER(samples), {1, 1e8}, "Points taken from each surface"),
        Make::number("seen-by", QUORUM_MEMBER(seen_by), {},
                     "With a scene: the truth that so many views see counts for completeness and recall; 0: all of it"),
        Make::length("hidden-by", QUORUM_MEMBER(hidden_by),
                     "A view does not see what lies more than this behind the truth")})
    add_option(line, arguments.options, option);
  line.add("--scene", arguments.scene, "Folder of the scene, for --seen-by");
  line.add("--workspace", arguments.workspace,
           "Folder with the depth maps, to tell in which stage what is missed was lost");
  line.add("--uncleaned", arguments.uncleaned,
           "The mesh of `quorum fuse --min-confidence 0 --min-component 0`, to tell fusion from clean-up");
  add_named_options(line, arguments.run, {"format", "images", "model", "max-image-size"});
  line.add_switch("--json", arguments.json, "Print JSON, in scene units");
  return run_command(line, argc, argv, [&] { return evaluate_files(arguments); });
}

}  // namespace quorum
