// The scenes of all formats: whatever the files of a folder say, read_scene gives a scene that its own rules allow, or
// a line. An input is the files of the folder (fuzz_folder.h); photographs are their first bytes, which say their size.
#include <cmath>
#include <cstdlib>

#include "engine/io/scene_folder.h"
#include "tests/fuzz/fuzz_folder.h"

namespace {

void require(bool truth) {
  if (!truth) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto& folder = quorum::fill_folder({reinterpret_cast<const char*>(data), size});
  const auto scene = quorum::read_scene(folder, {});
  if (!scene) {
    require(!scene.error().message.empty());
    return 0;
  }
  require(!scene->views.empty());
  for (const quorum::View& view : scene->views) {
    require(view.camera.intrinsics.allFinite() && view.camera.camera_from_world.allFinite());
    require(view.camera.translation.allFinite() && view.camera.intrinsics(0, 0) != 0.0);
    require(view.width > 0 && view.height > 0 && !view.name.empty());
  }
  for (const quorum::SparsePoint& point : scene->points) {
    require(point.position.allFinite());
    for (const int index : point.views) require(index >= 0 && index < static_cast<int>(scene->views.size()));
  }
  for (int axis = 0; axis < 3; ++axis) require(scene->bounds.low[axis] <= scene->bounds.high[axis]);
  return 0;
}
