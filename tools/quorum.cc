// The program `quorum`: a table of commands.
#include <fmt/format.h>

#include <string_view>

#include "engine/core/version.h"
#include "tools/command.h"

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
    {"fuse", "the mesh from depth maps computed before", quorum::fuse_command},
    {"evaluate", "accuracy and completeness of a mesh against the truth", quorum::evaluate_command},
    {"calibrate", "how far the confidences of depth maps can be trusted, against the truth", quorum::calibrate_command},
    {"render", "a picture of a mesh from one of the scene's cameras", quorum::render_command},
    {"convert", "a scene in the format of other programs", quorum::convert_command},
    {"synthesize", "make a scene with known surface to try things on", quorum::synthesize_command},
    {"experiment", "the experiments of the paper, with a table and figures", quorum::experiment_command},
    {"devices", "what a run could work on, and what it would choose", quorum::devices_command},
    {"bench", "what each stage costs here, and what it would cost at least", quorum::bench_command},
};

void print_help(std::FILE* out) {
  fmt::print(out, "Quorum {}: multi-view stereo with one result on every device.\n\n", quorum::version());
  fmt::print(out, "usage: quorum COMMAND [options]     quorum COMMAND --help     quorum --version\n\n");
  for (const Command& command : kCommands) fmt::print(out, "  {:<12} {}\n", command.name, command.summary);
  fmt::print(out, "\nTo begin: quorum synthesize scene && quorum reconstruct scene -o result\n");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  if (word == "--version") {
    fmt::print("quorum {}\n", quorum::version());
    return 0;
  }
  if (word == "--help" || word == "-h" || word == "help") {
    print_help(stdout);
    return 0;
  }
  for (const Command& command : kCommands)
    if (word == command.name) return command.run(argc - 1, argv + 1);
  if (word.empty())
    print_help(stderr);
  else
    fmt::print(stderr, "quorum: unknown command {}; see quorum --help\n", word);
  return static_cast<int>(quorum::ErrorKind::kUsage);
}
