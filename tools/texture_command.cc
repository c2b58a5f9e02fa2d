// quorum texture: a mesh with the photographs of its scene on it.
#include <fmt/format.h>

#include "engine/io/file.h"
#include "engine/io/mesh_file.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "engine/pipeline/texture_scene.h"
#include "host/run/open_backend.h"
#include "tools/add_options.h"
#include "tools/console_progress.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct TextureArguments {
  std::filesystem::path mesh;
  std::filesystem::path scene;
  std::filesystem::path output;
  std::string pages = "jpg";
  bool quiet = false;
  RunOptions options;
  TextureOptions texture;
};

Expected<void> texture_file(const TextureArguments& arguments) {
  QUORUM_TRY(check_textured_ending(arguments.output));
  QUORUM_TRY(check_not_input(arguments.output, {arguments.mesh}));
  QUORUM_TRY(check_writable(arguments.output));
  const ThreadLimit limit(arguments.options.threads);
  const MemoryBudget budget(arguments.options.memory_bytes);
  ConsoleProgress progress(arguments.quiet);
  QUORUM_ASSIGN(const Scene scene, read_scene(arguments.scene, arguments.options.files));
  for (const std::string& note : scene.notes) progress.note(note);
  QUORUM_ASSIGN(Mesh mesh, read_ply(arguments.mesh, scene.offset));
  auto textured = texture_scene(mesh, scene, arguments.texture, arguments.options.mask_below, budget, progress);
  progress.finish();
  if (!textured) return std::unexpected(textured.error().within(arguments.mesh.string()));
  mesh = Mesh();
  QUORUM_TRY(write_textured(arguments.output, textured->mesh, "." + arguments.pages));
  write_result(fmt::format("{}: {}\n", arguments.output.string(), describe(*textured)));
  return {};
}

}  // namespace

int texture_command(int argc, char** argv) {
  CommandLine line("Put the photographs of a scene on a mesh: each triangle is taken from one that shows it well.",
                   "texture");
  TextureArguments arguments;
  line.add("mesh", arguments.mesh, "PLY file").required();
  line.add("--scene", arguments.scene, "Folder of the scene").required();
  line.add("-o,--output", arguments.output, "File to write: .glb, or .obj with .mtl and pictures beside it").required();
  for (const Option<TextureOptions>& option : texture_option_table()) add_option(line, arguments.texture, option);
  line.add("--pages", arguments.pages, "Kind of the pictures").one_of({"jpg", "png"}).with_default();
  line.add_switch("--quiet", arguments.quiet, "Print nothing but errors and the result");
  add_named_options(line, arguments.options,
                    {"format", "images", "model", "masks", "mask-below", "max-image-size", "threads", "memory"});
  return run_command(line, argc, argv, [&] { return texture_file(arguments); });
}

}  // namespace quorum
