#include "engine/pipeline/write_model.h"

#include <fmt/format.h>

#include "engine/io/mesh_file.h"
#include "engine/mesh/simplify.h"
#include "engine/pipeline/texture_scene.h"

namespace quorum {
namespace {

Mesh simple_mesh(Run& run, const Mesh& mesh) {
  const StageTimer timer(run.report, "simplify");
  SimplifyOptions options;
  options.triangles = run.options.triangles;
  Mesh simple = simplify(mesh, options);
  simple.offset = mesh.offset;
  return simple;
}

}  // namespace

Expected<void> write_model(Run& run, const Mesh& mesh) {
  const Mesh simple = run.options.triangles > 0 ? simple_mesh(run, mesh) : Mesh();
  const Mesh& shown = run.options.triangles > 0 ? simple : mesh;
  const std::filesystem::path path = run.workspace.model_path();
  if (!run.options.texture) return write_mesh(path, shown);
  const StageTimer timer(run.report, "texture");
  QUORUM_ASSIGN(const Textured textured,
                texture_scene(shown, run.scene, TextureOptions(), run.options.mask_below, run.budget, run.progress));
  run.progress.note(fmt::format("{}: {}", path.string(), describe(textured)));
  return write_textured(path, textured.mesh, ".jpg");
}

}  // namespace quorum
