#include "tools/run_pipeline.h"

#include <fmt/format.h>

#include "engine/pipeline/run_json.h"
#include "host/run/open_backend.h"
#include "tools/messages.h"

namespace quorum {

void RunArguments::add_scene(CommandLine& line) {
  line.add("scene", scene,
           "Folder with the photographs and their cameras (Middlebury: *_par.txt, images, README.txt; "
           "COLMAP: images, sparse; nerfstudio, MVSNet, Bundler, OpenMVG, OpenSfM, Meshroom, Metashape, "
           "RealityCapture, VisualSFM)")
      .required();
}

void RunArguments::add_output(CommandLine& line) {
  line.add("-o,--output", output, "Folder for the results; made if missing").required();
  command = line.name();
  line.add_switch("--quiet", quiet, "Print nothing but errors");
  line.add_flag({"progress", "text or json", "text",
                 "How progress is told on standard error; json: an object a line, for programs", "Options", 1, 1,
                 [this](const std::vector<std::string>& words) -> Expected<void> {
                   if (words[0] != "text" && words[0] != "json")
                     return failure(ErrorKind::kUsage, fmt::format("--progress {}: give text or json", words[0]));
                   progress = words[0] == "json" ? ProgressForm::kJson : ProgressForm::kText;
                   return {};
                 }});
  line.add_switch("--json", json, "Print run.json to standard output at the end, and nothing else there");
}

void RunArguments::add_restart(CommandLine& line) {
  line.add_switch("--restart", restart,
                  "Make all anew, also what earlier runs made of the same photographs and options");
}

Expected<void> with_run(const RunArguments& arguments, const RunSteps& steps,
                        const std::function<Expected<void>(Run&)>& work) {
  QUORUM_TRY(arguments.options.check());
  const ThreadLimit limit(arguments.options.threads);
  ConsoleProgress progress(arguments.progress_form(), expected_stages(steps, arguments.options.shard.has_value()));
  QUORUM_ASSIGN(const Scene scene, read_scene(arguments.scene, arguments.options.files));
  return with_run(scene, arguments, progress, steps, work);
}

Expected<void> run_pipeline(const RunArguments& arguments, const RunSteps& steps) {
  return with_run(arguments, steps, [&](Run& run) -> Expected<void> {
    QUORUM_TRY(make_results(run, arguments, steps));
    if (arguments.json) write_result(run_json(run));
    return {};
  });
}

}  // namespace quorum
