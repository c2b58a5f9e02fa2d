#include "engine/pipeline/texture_scene.h"

#include <fmt/format.h>

#include "engine/pipeline/run.h"

namespace quorum {

Expected<Textured> texture_scene(const Mesh& mesh, const Scene& scene, const TextureOptions& options, double mask_below,
                                 const MemoryBudget& budget, Progress& progress) {
  ImageStore images(scene, 0, mask_below);  // photographs come one at a time
  TextureWatch watch;
  watch.require = [&](std::uint64_t bytes, std::string_view what_for) { return budget.require(bytes, what_for); };
  watch.stage = [&](std::string_view name, int steps) { progress.stage(name, steps); };
  watch.step = [&]() -> Expected<void> {
    progress.step();
    return progress.stop_requested() ? Expected<void>(std::unexpected(stopped())) : Expected<void>();
  };
  return texture_mesh(mesh, scene, images, options, watch);
}

std::string describe(const Textured& textured) {
  const TextureCounts& counts = textured.counts;
  std::string text = fmt::format("{} triangles, {} of them unseen; {} patches of {} photographs", counts.triangles,
                                 counts.unseen, counts.patches, counts.views);
  for (const ColorImage& page : textured.mesh.pages) text += fmt::format("; page of {} x {}", page.width, page.height);
  return text;
}

}  // namespace quorum
