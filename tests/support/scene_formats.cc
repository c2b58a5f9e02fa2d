#include "tests/support/scene_formats.h"

#include <fmt/format.h>

#include <string>

#include "engine/io/colmap.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

void write_mvsnet_files(const fs::path& folder, const Scene& scene) {
  fs::create_directories(folder / "cams");
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const Camera& camera = scene.views[i].camera;
    std::string text = "extrinsic\n";
    for (int row = 0; row < 3; ++row)
      text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", camera.camera_from_world(row, 0),
                          camera.camera_from_world(row, 1), camera.camera_from_world(row, 2), camera.translation(row));
    text += fmt::format("0 0 0 1\n\nintrinsic\n{:.17g} 0 {:.17g}\n0 {:.17g} {:.17g}\n0 0 1\n\n2.5 0.05\n",
                        camera.intrinsics(0, 0), camera.intrinsics(0, 2) + 0.5, camera.intrinsics(1, 1),
                        camera.intrinsics(1, 2) + 0.5);
    write_text(folder / fmt::format("cams/{:08}_cam.txt", i), text);
    fs::rename(folder / "images" / scene.views[i].image_name, folder / fmt::format("images/{:08}.png", i));
  }
  write_text(folder / "pair.txt", "4\n0\n3 2 9.5 1 8 3 1\n1\n2 0 5 2 4\n2\n1 3 1\n3\n0\n");
}

void write_transforms_file(const fs::path& folder, const Scene& scene) {
  std::string frames;
  for (const View& view : scene.views) {
    const Eigen::Matrix3d r = view.camera.camera_from_world.transpose();
    const Eigen::Vector3d c = view.camera.center();
    std::string rows;
    for (int row = 0; row < 3; ++row)
      rows += fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}], ", r(row, 0), -r(row, 1), -r(row, 2), c(row));
    frames += fmt::format(
        "{}{{\"file_path\": \"./images/{}\", \"transform_matrix\": [{}[0, 0, 0, 1]], \"cx\": {:.17g}, \"w\": {}}}",
        frames.empty() ? "" : ",\n", view.image_name, rows, view.camera.intrinsics(0, 2) + 0.5, view.width);
  }
  const Eigen::Matrix3d& k = scene.views[0].camera.intrinsics;
  write_text(folder / "transforms.json",
             fmt::format("{{\"fl_x\": {}, \"fl_y\": {}, \"cy\": {}, \"h\": 48, \"frames\": [\n{}]}}\n", k(0, 0),
                         k(1, 1), k(1, 2) + 0.5, frames));
}

/// With focal length 70, the principal point in the center, and a camera that was not found.
void write_bundler_files(const fs::path& folder, const Scene& scene) {
  std::string list;
  std::string bundle = "# Bundle file v0.3\n5 3\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n";
  for (const View& view : scene.views) {
    const Camera& camera = view.camera;
    bundle += "70 -0.1 0.02\n";
    for (int row = 0; row < 3; ++row) {
      const double sign = row == 0 ? 1 : -1;
      bundle += fmt::format("{:.17g} {:.17g} {:.17g}\n", sign * camera.camera_from_world(row, 0),
                            sign * camera.camera_from_world(row, 1), sign * camera.camera_from_world(row, 2));
    }
    bundle += fmt::format("{:.17g} {:.17g} {:.17g}\n", camera.translation.x(), -camera.translation.y(),
                          -camera.translation.z());
    list += "images/" + view.image_name + " 0 70\n";
  }
  bundle += "0.1 0.2 0.3\n1 2 3\n3 1 5 0.5 0.5 4 7 1 1 2 3 0 0\n0 0 0\n1 2 3\n2 0 1 1 1 3 2 2 2\n1 1 1\n0 0 0\n0\n";
  write_text(folder / "bundle.out", bundle);
  write_text(folder / "list.txt", "images/lost.png\n" + list);
}

}  // namespace

Scene write_scene_formats(const fs::path& folder, const ColmapModel& model) {
  write_colmap_scene(folder / "colmap", model);
  Scene scene = read_colmap(folder / "colmap", {}).value();
  for (const char* name : {"mvsnet", "transforms", "bundler"}) {
    fs::create_directories(folder / name);
    fs::copy(folder / "colmap/images", folder / name / "images");
  }
  write_mvsnet_files(folder / "mvsnet", scene);
  write_transforms_file(folder / "transforms", scene);
  write_bundler_files(folder / "bundler", scene);
  return scene;
}

}  // namespace quorum
