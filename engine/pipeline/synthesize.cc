#include "engine/pipeline/synthesize.h"

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/middlebury.h"
#include "engine/io/ply.h"

namespace quorum {

Expected<void> synthesize_temple(const std::filesystem::path& folder, const TempleOptions& options) {
  constexpr double kSurfaceEdge = 0.001;  // of the triangles of gt.ply, meters
  if (auto checked = options.check(); !checked) return checked;
  if (auto made = make_folder(folder); !made) return made;
  const Scene scene = make_temple_scene(options);
  for (int view = 0; view < static_cast<int>(scene.views.size()); ++view) {
    const auto path = folder / scene.views[static_cast<std::size_t>(view)].image_path;
    if (auto written = write_png(path, render_temple(scene, view, options)); !written) return written;
  }
  if (auto written = write_ply(folder / "gt.ply", temple_surface(kSurfaceEdge)); !written) return written;
  return write_middlebury(folder, "temple", scene);
}

}  // namespace quorum
