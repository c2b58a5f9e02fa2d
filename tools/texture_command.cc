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
  CLI::App app("Put the photographs of a scene on a mesh: each triangle is taken from one that shows it well.",
               "texture");
  TextureArguments arguments;
  app.add_option("mesh", arguments.mesh, "PLY file")->required();
  app.add_option("--scene", arguments.scene, "Folder of the scene")->required();
  app.add_option("-o,--output", arguments.output, "File to write: .glb, or .obj with .mtl and pictures beside it")
      ->required();
  for (const Option<TextureOptions>& option : texture_option_table()) add_option(app, arguments.texture, option);
  app.add_option("--pages", arguments.pages, "Kind of the pictures")
      ->check(CLI::IsMember({"jpg", "png"}))
      ->capture_default_str();
  app.add_flag("--quiet", arguments.quiet, "Print nothing but errors and the result");
  add_named_options(app, arguments.options,
                    {"format", "images", "model", "masks", "mask-below", "max-image-size", "threads", "memory"});
  return run_command(app, argc, argv, [&] { return texture_file(arguments); });
}

}  // namespace quorum
