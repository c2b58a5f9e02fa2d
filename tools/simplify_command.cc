// quorum simplify: a mesh of fewer triangles, in the format that the ending of its name says.
#include <fmt/format.h>

#include "engine/core/option.h"
#include "engine/io/mesh_file.h"
#include "engine/io/ply.h"
#include "engine/mesh/simplify.h"
#include "tools/command.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct SimplifyArguments {
  std::filesystem::path mesh;
  std::filesystem::path output;
  std::string triangles;
  std::string error;
};

Expected<SimplifyOptions> simplify_options(const SimplifyArguments& arguments) {
  SimplifyOptions options;
  if (!arguments.triangles.empty()) {
    const auto count = parse_count(arguments.triangles);
    if (!count)
      return failure(ErrorKind::kUsage,
                     fmt::format("--triangles {}: give a number such as 200000, 500k or 1.5M", arguments.triangles));
    options.triangles = *count;
  }
  if (!arguments.error.empty()) {
    const auto error = parse_length(arguments.error);
    if (!error || !(*error > 0))
      return failure(ErrorKind::kUsage, fmt::format("--error {}: give a length such as 0.5mm", arguments.error));
    options.error = *error;
  }
  return options;
}

Expected<void> simplify_file(const SimplifyArguments& arguments) {
  QUORUM_ASSIGN(const SimplifyOptions options, simplify_options(arguments));
  QUORUM_TRY(check_mesh_ending(arguments.output));
  QUORUM_TRY(check_not_input(arguments.output, {arguments.mesh}));
  QUORUM_ASSIGN(const Mesh mesh, read_ply(arguments.mesh));
  if (arguments.triangles.empty() && arguments.error.empty()) return write_mesh(arguments.output, mesh);
  if (mesh.triangles.empty())
    return failure(ErrorKind::kInput,
                   fmt::format("{}: has no triangles to simplify; leave out --triangles and --error to write a cloud",
                               arguments.mesh.string()));
  double error = 0;
  const Mesh simple = simplify(mesh, options, &error);
  QUORUM_TRY(write_mesh(arguments.output, simple));
  write_result(fmt::format("{} of {} triangles, {} of {} vertices; deviation about {:.3g} scene units\n",
                           simple.triangles.size(), mesh.triangles.size(), simple.vertices.size(), mesh.vertices.size(),
                           error));
  if (options.triangles > 0 && simple.triangles.size() > options.triangles)
    tell(fmt::format("more than {} triangles: the parts of the mesh stay{}", arguments.triangles,
                     arguments.error.empty() ? "" : ", and so does --error"));
  return {};
}

}  // namespace

int simplify_command(int argc, char** argv) {
  CommandLine line(
      "Write a mesh with fewer triangles, or as it is in another format. Colors and confidences are kept, and borders "
      "as far as they don't take the triangles of the surface.",
      "simplify");
  SimplifyArguments arguments;
  line.add("mesh", arguments.mesh, "PLY file").required();
  line.add("-o,--output", arguments.output, "File to write, .ply, .glb, .obj or .stl").required();
  line.add("--triangles", arguments.triangles, "Stop at so many triangles: 200000, 500k, 1.5M");
  line.add("--error", arguments.error, "Deviate no more than this from the surface, as 0.5mm");
  return run_command(line, argc, argv, [&] { return simplify_file(arguments); });
}

}  // namespace quorum
