#include "tests/support/fusion_scene.h"

#include "engine/io/write_image.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

DepthMap exact_map(const View& view, bool hole) {
  DepthMap map;
  map.depth = map.correlation = map.confidence = Grid<float>(view.width, view.height);
  map.normal = Grid<Eigen::Vector3f>(view.width, view.height, Eigen::Vector3f::Zero());
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const double depth = sphere_depth(view, x, y);
      const Eigen::Vector3d direction = view.camera.unproject(x, y, depth).normalized();
      if (hole && direction.dot(FusionScene::hole_center()) > FusionScene::kHoleCosine) continue;
      map.depth.at(x, y) = static_cast<float>(depth);
      if (map.depth.at(x, y) <= 0) continue;
      map.correlation.at(x, y) = map.confidence.at(x, y) = 1.0F;
      map.normal.at(x, y) = (view.camera.camera_from_world * direction).cast<float>();
    }
  }
  return map;
}

}  // namespace

FusionScene::FusionScene(bool hole) {
  SphereScene sphere = make_surrounding_sphere_scene(8, 121, 101, 1);
  scene_ = sphere.scene;
  const Workspace workspace = Workspace::open(folder_.path()).value();
  for (std::size_t index = 0; index < scene_.views.size(); ++index) {
    View& view = scene_.views[index];
    view.name = "view" + std::to_string(index);
    view.image_path = folder_.path() / (view.name + ".png");
    write_png(view.image_path, sphere.images[index]).value();
    workspace.save_depth_map(view.name, exact_map(view, hole)).value();
  }
}

void FusionScene::mask_pixel(std::size_t view, int x, int y) {
  ColorImage mask(scene_.views[view].width, scene_.views[view].height, make_rgb(255, 255, 255));
  mask.at(x, y) = make_rgb(0, 0, 0);
  scene_.views[view].mask_path = folder_.path() / "mask.png";
  write_png(scene_.views[view].mask_path, mask).value();
}

Expected<Mesh> FusionScene::fuse(Backend& backend, RunReport& report, std::uint64_t memory_bytes) const {
  FusionOptions options;
  options.voxel_size = kVoxelSize;
  return fuse(backend, report, options, memory_bytes, 0.0);
}

Expected<Mesh> FusionScene::fill(Backend& backend, RunReport& report, double mask_below, double voxel_size) const {
  FusionOptions options;
  options.voxel_size = voxel_size;
  options.fill_holes = true;
  return fuse(backend, report, options, 0, mask_below);
}

Expected<Mesh> FusionScene::fuse(Backend& backend, RunReport& report, const FusionOptions& given,
                                 std::uint64_t memory_bytes, double mask_below) const {
  RunOptions options;
  options.fusion = given;
  options.fusion.truncation = 0.3;
  options.fusion.max_slope_deg = 70;  // rims of these coarse maps are too far apart beyond
  options.mask_below = mask_below;
  options.confirm = false;
  options.min_confidence = 0.0F;
  options.memory_bytes = memory_bytes;
  const Workspace workspace = Workspace::open(folder_.path()).value();
  Progress progress;
  Run run{scene_, options, backend, workspace, progress};
  auto mesh = fuse_views(run, run.views_with_depth_map().value());
  report = run.report;
  return mesh;
}

}  // namespace quorum
