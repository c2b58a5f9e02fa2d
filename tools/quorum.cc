// The program `quorum`: a table of commands.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/did_you_mean.h"
#include "engine/core/error_of.h"
#include "engine/core/version.h"
#include "engine/io/temporary_file.h"
#include "tools/command.h"
#include "tools/messages.h"
#include "tools/signals.h"
#include "tools/stacks.h"

namespace {

struct Command {
  std::string_view name;
  std::string_view summary;
  int (*run)(int argc, char** argv);
};

constexpr Command kCommands[] = {
    {"reconstruct", "photographs with known cameras to depth maps and a mesh", quorum::reconstruct_command},
    {"photos", "plain photographs to depth maps and a mesh, with the installed colmap", quorum::photos_command},
    {"depth", "the depth maps alone", quorum::depth_command},
    {"confirm", "the certainty of depth maps computed before", quorum::confirm_command},
    {"fuse", "the mesh from depth maps computed before", quorum::fuse_command},
    {"join", "the mesh from what all shards of fuse measured", quorum::join_command},
    {"plan", "what a run will take: sizes, memory, disk, time, shards", quorum::plan_command},
    {"submit", "a run in shards by Slurm", quorum::submit_command},
    {"status", "what an output folder holds, what it was made from, and what is missing", quorum::status_command},
    {"evaluate", "accuracy and completeness of a mesh against the truth", quorum::evaluate_command},
    {"calibrate", "how far the confidences of depth maps can be trusted, against the truth", quorum::calibrate_command},
    {"render", "a picture of a mesh from one of the scene's cameras", quorum::render_command},
    {"report", "a page to look at a finished run and its mesh", quorum::report_command},
    {"simplify", "a mesh of fewer triangles, or in another format", quorum::simplify_command},
    {"texture", "a mesh with the photographs of its scene on it", quorum::texture_command},
    {"convert", "a scene in the format of other programs", quorum::convert_command},
    {"synthesize", "make a scene with known surface to try things on", quorum::synthesize_command},
    {"experiment", "the experiments of the paper, with a table and figures", quorum::experiment_command},
    {"devices", "what a run could work on, and what it would choose", quorum::devices_command},
    {"bench", "what each stage costs here, and what it would cost at least", quorum::bench_command},
    {"verify", "whether a device gives the bytes that every device must give", quorum::verify_command},
};

std::string help() {
  std::string text =
      fmt::format("Quorum {}: multi-view stereo with one result on every device.\n\n", quorum::version());
  text += "usage: quorum COMMAND [options]     quorum help COMMAND     quorum --version\n\n";
  for (const Command& command : kCommands) text += fmt::format("  {:<12} {}\n", command.name, command.summary);
  return text + "\nTo begin: quorum synthesize scene && quorum reconstruct scene -o result\n";
}

/// The commands for scripts, a line each.
std::string describe() {
  std::string lines;
  for (const Command& command : kCommands) lines += fmt::format("{}\t{}\n", command.name, command.summary);
  return lines;
}

int show(std::string_view text) {
  quorum::write_result(text);
  const auto shown = quorum::flush_results();
  return shown ? 0 : quorum::fail("quorum", shown.error());
}

std::string suggestion(std::string_view word) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  return quorum::did_you_mean(word, names);
}

int run(std::string_view word, int argc, char** argv) {
  if (word == "--version") return show(fmt::format("quorum {}\n", quorum::version()));
  if (word == "--describe") return show(describe());
  if (word == "--help" || word == "-h" || (word == "help" && argc < 3)) return show(help());
  if (word == "help") {
    std::string name = argv[2];
    std::string option = "--help";
    char* words[] = {argv[0], name.data(), option.data(), nullptr};
    return run(name, 3, words);
  }
  for (const Command& command : kCommands)
    if (word == command.name) return command.run(argc - 1, argv + 1);
  if (word.empty())
    quorum::write_message(help());
  else
    quorum::tell(fmt::format("quorum: unknown command {}{}; see quorum --help", word, suggestion(word)));
  return static_cast<int>(quorum::ErrorKind::kUsage);
}

/// Ends by a line and a code. Not by exit(): what threw may be in no state to be taken down.
[[noreturn]] void end_by_exception(std::string_view command) {
  static std::atomic_flag is_ending;
  while (is_ending.test_and_set()) ::pause();  // another thread ends already
  const std::exception_ptr exception = std::current_exception();
  using quorum::ErrorKind;
  const int code = quorum::fail(
      command, exception ? quorum::error_of(exception) : quorum::Error{ErrorKind::kDevice, "unexpected failure"});
  quorum::remove_temporary_files();
  ::_exit(code);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  quorum::open_messages();
  quorum::handle_signals();
  // Exceptions that can reach no caller, such as one in a thread of a library.
  std::set_terminate([] { end_by_exception("quorum"); });
  try {
    if (const auto allowed = quorum::allow_stacks(); !allowed) return quorum::fail(word, allowed.error());
    return run(word, argc, argv);
  } catch (...) {
    end_by_exception(word);
  }
}
