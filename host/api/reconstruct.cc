#include <fmt/format.h>
#include <quorum/reconstruct.h>

#include "engine/core/clock.h"
#include "host/api/boundary.h"
#include "host/api/options_state.h"
#include "host/api/results_state.h"
#include "host/api/scene_state.h"
#include "host/run/open_run.h"

namespace quorum::v0 {
namespace {

using quorum::Expected;

/// Tells the caller's functions. The first exception of one of them is kept, and stops the run.
class CallersProgress : public quorum::Progress {
 public:
  CallersProgress(const RunSettings& settings, std::vector<quorum::StageWeight> expected)
      : settings_(settings), meter_(std::move(expected)) {}

  void stage(std::string_view name, int steps) override {
    meter_.stage(name, steps, quorum::wall_seconds());
    tell();
  }
  void step() override {
    meter_.step(quorum::wall_seconds());
    tell();
  }
  void note(std::string_view text) override {
    if (settings_.on_note) guarded([&] { settings_.on_note(text); });
  }
  void finish() override { meter_.end_stage(); }
  [[nodiscard]] bool stop_requested() const override {
    bool stops = false;
    if (settings_.should_stop) guarded([&] { stops = settings_.should_stop(); });
    return stops || thrown_;
  }
  /// Throws what was kept.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void tell() {
    if (settings_.on_progress)
      guarded([&] {
        settings_.on_progress({meter_.name(), meter_.done(), meter_.steps(), meter_.percent(), meter_.run_percent(),
                               meter_.seconds_left(), meter_.run_seconds_left()});
      });
  }
  template <typename Work>
  void guarded(const Work& work) const {
    if (thrown_) return;
    try {
      work();
    } catch (...) {
      thrown_ = std::current_exception();
    }
  }

  const RunSettings& settings_;
  quorum::ProgressMeter meter_;
  mutable std::exception_ptr thrown_;
};

/// The options of the run, with those of the scene as it was read.
Expected<quorum::RunOptions> run_options_for(const Scene& scene, const Options& options) {
  QUORUM_ASSIGN(quorum::RunOptions run, run_options_of(options));
  const quorum::RunOptions& read = scene.state()->options;
  for (const quorum::RunOption& row : quorum::run_option_table())
    if (row.stage == quorum::RunStage::kScene && is_given(options, row.name) && row.text(run) != row.text(read))
      return quorum::failure(quorum::ErrorKind::kUsage,
                             fmt::format("{} {}: the scene was read with \"{}\"; give the option to Scene::read or "
                                         "Scene::from_arrays",
                                         quorum::option_name(row.name), row.text(run), row.text(read)));
  run.files = read.files;
  return run;
}

Expected<Results> run(const Scene& scene, const Options& options, const RunSettings& settings,
                      const quorum::RunSteps& steps, quorum::Progress& progress) {
  quorum::RunRequest request;
  QUORUM_ASSIGN(request.options, run_options_for(scene, options));
  if (settings.report_page && !settings.mesh)
    return quorum::failure(quorum::ErrorKind::kUsage, "RunSettings::report_page: needs the mesh; leave it out");
  request.output = settings.workspace;
  request.command = "reconstruct";
  request.restart = settings.restart;
  request.report = settings.report_page;
  std::optional<quorum::ScratchFolder> files;
  if (settings.workspace.empty()) {
    QUORUM_ASSIGN(quorum::ScratchFolder made, quorum::ScratchFolder::make());
    request.output = made.path();
    files.emplace(std::move(made));
    if (!is_given(options, "previews")) request.options.previews = quorum::Previews::kNone;  // nobody looks there
  }
  QUORUM_TRY(quorum::with_run(scene.state()->scene, request, progress, steps,
                              [&](quorum::Run& run) { return quorum::make_results(run, request, steps); }));
  return Results(
      std::make_shared<const Results::State>(scene, quorum::Workspace::at(request.output), std::move(files)));
}

}  // namespace

Result<Results> reconstruct(const Scene& scene, const Options& options, const RunSettings& settings) {
  const quorum::RunSteps steps{.mesh = settings.mesh};
  CallersProgress progress(settings, quorum::expected_stages(steps, false));
  auto results = at_boundary<Results>([&] { return run(scene, options, settings, steps, progress); });
  progress.rethrow();
  return results;
}

}  // namespace quorum::v0
