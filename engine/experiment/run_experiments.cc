#include "engine/experiment/run_experiments.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/experiment/report.h"
#include "engine/io/contact_sheet.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/write_image.h"

namespace quorum {
namespace {

constexpr int kPanelWidth = 300;  // pixels of a figure's panel, at most

/// An experiment with those of its runs whose scenes are there.
struct Plan {
  const Experiment* experiment = nullptr;
  std::vector<std::size_t> runs;
};

Expected<std::vector<const Experiment*>> find_experiments(const Catalog& catalog,
                                                          const std::vector<std::string>& names) {
  std::vector<const Experiment*> found;
  for (const std::string& name : names) {
    const std::size_t before = found.size();
    for (const Experiment& experiment : catalog.experiments)
      if (name == "all" || name == experiment.name) found.push_back(&experiment);
    if (found.size() > before) continue;
    std::string known = "all";
    for (const Experiment& experiment : catalog.experiments) known += ", " + experiment.name;
    return failure(ErrorKind::kUsage, fmt::format("{}: no such experiment; there are {}", name, known));
  }
  return found;
}

/// Names the data sets that are missing, in their order; empty if none is.
std::string missing_scenes(const Catalog& catalog, const std::vector<const Experiment*>& chosen,
                           const SceneShelf& shelf) {
  std::set<std::string> wanted;
  for (const Experiment* experiment : chosen)
    for (const RunSettings& run : experiment->runs) wanted.insert(run.scene);
  std::string missing;
  for (const ExperimentScene& scene : catalog.scenes)
    if (wanted.contains(scene.name) && !shelf.has(scene)) missing += (missing.empty() ? "" : ", ") + scene.name;
  return missing;
}

/// Says what is left out for want of data, and plans the rest.
Expected<std::vector<Plan>> make_plans(const Catalog& catalog, const std::vector<const Experiment*>& chosen,
                                       const SceneShelf& shelf, const std::filesystem::path& data, Progress& progress) {
  std::vector<Plan> plans;
  std::size_t planned = 0;
  std::size_t left_out = 0;
  for (const Experiment* experiment : chosen) {
    Plan& plan = plans.emplace_back(Plan{experiment, {}});
    for (std::size_t run = 0; run < experiment->runs.size(); ++run) {
      if (shelf.has(find_scene(catalog.scenes, experiment->runs[run].scene)))
        plan.runs.push_back(run);
      else
        ++left_out;
    }
    planned += plan.runs.size();
  }
  const std::string missing = missing_scenes(catalog, chosen, shelf);
  const std::string place = data.empty() ? "give the folder that holds them with --data" : "not in " + data.string();
  if (planned == 0)
    return failure(
        ErrorKind::kInput,
        fmt::format("needs the data sets {}: {}; `quorum experiment all` runs what needs none", missing, place));
  if (left_out > 0)
    progress.note(fmt::format("{} of {} runs are left out, they need the data sets {}: {}", left_out,
                              planned + left_out, missing, place));
  return plans;
}

/// Draws the figures of which all runs are there.
Expected<void> draw_figures(ExperimentResult& result, const RunMaker& maker, const std::filesystem::path& folder) {
  for (const Figure& figure : result.experiment->figures) {
    std::vector<Panel> panels;
    bool complete = true;
    for (const Figure::Panel& panel : figure.panels) {
      const auto run = std::ranges::find(result.runs, panel.run, &RunResult::run);
      complete = complete && run != result.runs.end() && run->record.problem.empty();
      if (!complete) break;
      const std::filesystem::path path = maker.picture_path(run->record, panel.picture);
      std::error_code ignored;
      ColorImage image;
      if (std::filesystem::exists(path, ignored)) {
        QUORUM_ASSIGN(auto read, read_image(path));
        image = read.width > kPanelWidth ? scale_to_width(read, kPanelWidth) : std::move(read);
      }
      panels.push_back({std::move(image), panel.caption});
    }
    if (!complete) continue;
    QUORUM_TRY(write_png(folder / (figure.name + ".png"), contact_sheet(panels, figure.columns)));
    result.figures.push_back(figure.name);
  }
  return {};
}

Expected<void> write_tables(const std::vector<ExperimentResult>& results, const std::filesystem::path& folder) {
  QUORUM_TRY(write_file(folder / "experiments.json", results_json(results)));
  return write_file(folder / "experiments.md", results_markdown(results));
}

}  // namespace

Expected<void> run_experiments(const Catalog& catalog, const ExperimentArguments& arguments, Backend& backend,
                               Progress& progress) {
  QUORUM_ASSIGN(const auto chosen, find_experiments(catalog, arguments.names));
  const SceneShelf shelf(arguments.data, arguments.output / "scenes");
  QUORUM_ASSIGN(const auto plans, make_plans(catalog, chosen, shelf, arguments.data, progress));
  QUORUM_TRY(make_folder(arguments.output / "figures"));

  RunMaker maker(arguments.output, catalog.scenes, shelf, backend, progress);
  std::vector<ExperimentResult> results;
  for (const Plan& plan : plans) {
    ExperimentResult& result = results.emplace_back(ExperimentResult{plan.experiment, {}, {}});
    progress.stage(fmt::format("experiment {}", plan.experiment->name), static_cast<int>(plan.runs.size()));
    for (const std::size_t run : plan.runs) {
      const RunSettings& settings = plan.experiment->runs[run];
      QUORUM_ASSIGN(auto record, maker.run(settings));
      progress.note((maker.was_made() ? "" : "kept: ") + result_line(settings, record));
      result.runs.push_back({run, std::move(record)});
      progress.step();
    }
    QUORUM_TRY(draw_figures(result, maker, arguments.output / "figures"));
    QUORUM_TRY(write_tables(results, arguments.output));
  }
  return {};
}

}  // namespace quorum
