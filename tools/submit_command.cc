// quorum submit: a run in shards by Slurm, an array of jobs for each stage, each of which waits for the one before it.
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "engine/io/file.h"
#include "engine/pipeline/workspace.h"
#include "tools/messages.h"
#include "tools/run_pipeline.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// An option as it was given.
struct GivenOption {
  RunStage stage;
  std::string name;
  std::vector<std::string> words;
};

struct Submission {
  fs::path scene;
  fs::path output;
  int shards = 0;
  bool dry_run = false;
  std::vector<GivenOption> given;
  std::vector<std::string> sbatch;  ///< options for it
};

/// A stage of the run as Slurm gets it.
struct Job {
  const char* command;
  bool is_array;
  std::vector<RunStage> stages;  ///< whose options it takes
};
const std::array<Job, 4> kJobs = {
    {{"depth", true, {RunStage::kScene, RunStage::kDepth, RunStage::kFiles, RunStage::kNone}},
     {"confirm", true, {RunStage::kScene, RunStage::kConfirm, RunStage::kFiles, RunStage::kNone}},
     {"fuse", true, {RunStage::kScene, RunStage::kConfirm, RunStage::kFusion, RunStage::kNone}},
     {"join", false, {RunStage::kScene, RunStage::kClean, RunStage::kExtras, RunStage::kNone}}}};

/// A word for a POSIX shell.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=:,+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

bool takes(const Job& job, const GivenOption& option) {
  // Of the options of depth maps the mask alone is for the fusion, too: with fill-holes, what is dark is background.
  const bool is_mask = option.name == "mask-below" && std::string_view(job.command) == "fuse";
  return is_mask || std::ranges::count(job.stages, option.stage) > 0;
}

/// What a node runs. Threads and memory are what Slurm gives the job, unless the user says so.
std::string script_of(const Submission& submission, const Job& job, const fs::path& program) {
  const auto is_given = [&](std::string_view name) {
    return std::ranges::count(submission.given, name, &GivenOption::name) > 0;
  };
  std::string log = (submission.output / "slurm" / job.command).string();
  for (std::size_t at = 0; (at = log.find('%', at)) != std::string::npos; at += 2) log.insert(at, 1, '%');
  std::string text = fmt::format(
      "#!/bin/sh\n# Made by quorum submit. What is done is kept, so this may be submitted again.\n"
      "#SBATCH --job-name=quorum-{}\n#SBATCH --output=\"{}{}.log\"\n#SBATCH --open-mode=append\n#SBATCH --requeue\n",
      job.command, log, job.is_array ? "-%a" : "");
  if (job.is_array) text += fmt::format("#SBATCH --array=1-{}\n", submission.shards);
  text += fmt::format("set -- {} {} -o {}", job.command, quoted(submission.scene.string()),
                      quoted(submission.output.string()));
  if (job.is_array) text += fmt::format(" --shard \"$SLURM_ARRAY_TASK_ID/{}\"", submission.shards);
  for (const GivenOption& option : submission.given) {
    if (!takes(job, option)) continue;
    text += " --" + option.name;
    for (const std::string& word : option.words) text += fmt::format(" {}", quoted(word));
  }
  text += "\n";
  if (!is_given("threads")) text += "set -- \"$@\" --threads \"${SLURM_CPUS_ON_NODE:-0}\"\n";
  if (!is_given("memory"))
    text +=
        "[ \"${SLURM_MEM_PER_NODE:-0}\" -eq 0 ] || set -- \"$@\" --memory \"$((SLURM_MEM_PER_NODE * 15 / 16))MiB\"\n";
  text += fmt::format("exec {} \"$@\"\n", quoted(program.string()));
  return text;
}

std::string sbatch_line(const Submission& submission, const fs::path& script, const std::string& after) {
  std::string line = "sbatch --parsable";
  for (const std::string& word : submission.sbatch) line += fmt::format(" {}", quoted(word));
  if (!after.empty()) line += fmt::format(" --dependency=afterok:{} --kill-on-invalid-dep=yes", after);
  line += fmt::format(" {}", quoted(script.string()));
  return line;
}

/// Runs sbatch; its number for the job. submitted: jobs so far.
Expected<std::string> hand_over(const std::string& line, const std::string& submitted) {
  const std::string remedy =
      submitted.empty() ? "" : fmt::format("; `scancel{}` takes back what was submitted", submitted);
  std::FILE* pipe = ::popen((line + " 2>&1").c_str(), "r");  // NOLINT(cert-env33-c): the words are quoted
  if (pipe == nullptr) return failure(ErrorKind::kDevice, "sbatch: no process can be made" + remedy);
  std::string said;
  std::array<char, 256> piece;
  while (std::fgets(piece.data(), piece.size(), pipe) != nullptr) said += piece.data();
  const int status = ::pclose(pipe);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  if (code == 127)
    return failure(ErrorKind::kInput,
                   "sbatch: is not installed here; submit where Slurm is, or give --dry-run and run what that prints");
  while (!said.empty() && said.back() == '\n') said.pop_back();
  const std::string last = said.substr(said.rfind('\n') + 1);  // after warnings, if there are any
  std::string number = last.substr(0, last.find(';'));
  if (code != 0 || number.empty())
    return failure(ErrorKind::kInput,
                   fmt::format("sbatch: refuses `{}` (exit code {}): {}{}", line, code, last, remedy));
  return number;
}

Expected<void> submit(Submission submission) {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  submission.scene = fs::absolute(submission.scene).lexically_normal();
  submission.output = fs::absolute(submission.output).lexically_normal();
  if (!submission.dry_run) {
    QUORUM_TRY(Workspace::open(submission.output));
    QUORUM_TRY(make_folder(submission.output / "slurm"));
  }
  std::string before;
  std::string submitted;
  for (const Job& job : kJobs) {
    const fs::path path = submission.output / "slurm" / fmt::format("{}.sh", job.command);
    const std::string script = script_of(submission, job, program);
    if (submission.dry_run) {
      print("# {}\n{}\n# {}\n\n", path.string(), script, sbatch_line(submission, path, before));
      before = fmt::format("${}", job.command);
      continue;
    }
    QUORUM_TRY(write_file(path, script));
    QUORUM_ASSIGN(before, hand_over(sbatch_line(submission, path, before), submitted));
    submitted += " " + before;
    print("{:<8} job {}{}\n", job.command, before, job.is_array ? fmt::format(", {} shards", submission.shards) : "");
  }
  if (!submission.dry_run)
    tell(fmt::format("squeue shows the jobs, quorum status {} what is done, {} what they say",
                     submission.output.string(), (submission.output / "slurm").string()));
  return {};
}

/// The options of all stages; what is given is kept, in its words, too.
void add_given_options(CommandLine& line, RunOptions& options, std::vector<GivenOption>& given) {
  for (const RunOption& option : run_option_table()) {
    if (option.stage == RunStage::kShards) continue;
    RunOption kept = option;
    kept.parse = [&given, option](RunOptions& of, const std::vector<std::string>& words) -> Expected<void> {
      QUORUM_TRY(option.parse(of, words));
      given.push_back({option.stage, option.given_name(), words});
      return {};
    };
    add_option(line, options, kept, stage_heading(option.stage));
  }
}

}  // namespace

int submit_command(int argc, char** argv) {
  CommandLine line("Hand a run to Slurm, in shards: quorum submit SCENE -o OUT --shards N -- [options of sbatch].",
                   "submit");
  Submission submission;
  RunOptions options;
  line.add("scene", submission.scene, "Folder with the photographs and their cameras, seen by all nodes").required();
  line.add("-o,--output", submission.output, "Folder for the results, seen by all nodes; made if missing").required();
  line.add("--shards", submission.shards, "Jobs of each stage").required().between(1, kMostShards);
  line.add_switch("--dry-run", submission.dry_run, "Print the scripts and the calls of sbatch, and do nothing");
  add_given_options(line, options, submission.given);
  const int own = static_cast<int>(std::find(argv + 1, argv + argc, std::string_view("--")) - argv);
  submission.sbatch.assign(argv + std::min(own + 1, argc), argv + argc);
  return run_command(line, own, argv, [&]() -> Expected<void> {
    QUORUM_TRY(options.check());
    QUORUM_TRY(read_scene(submission.scene, options.files));
    return submit(submission);
  });
}

}  // namespace quorum
