// Whole runs on cameras as people carry them, with exact poses and nothing else: neither points nor a box.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "engine/io/write_image.h"
#include "engine/pipeline/cpu_backend.h"
#include "engine/pipeline/reconstruct.h"
#include "tests/engine/scene/camera_paths.h"
#include "tests/engine/scene/path_images.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// The scene as a folder with photographs and transforms.json, which gives poses alone.
void write_scene(const fs::path& folder, const Scene& scene, const Surface& surface) {
  fs::create_directories(folder / "images");
  std::string frames;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    const View& view = scene.views[i];
    const std::string name = fmt::format("images/{:03}.png", i);
    constexpr double kFineness = 2.5;  // waves of seven pixels and more
    ASSERT_TRUE(write_png(folder / name, image_of(view, surface, kFineness)));
    const Eigen::Matrix3d& r = view.camera.camera_from_world;
    const Eigen::Matrix3d& k = view.camera.intrinsics;
    frames += fmt::format(
        R"({}{{"file_path": "{}", "w": {}, "h": {}, "fl_x": {}, "fl_y": {}, "cx": {}, "cy": {}, "transform_matrix": [)",
        i == 0 ? "" : ",\n", name, view.width, view.height, k(0, 0), k(1, 1), k(0, 2) + 0.5, k(1, 2) + 0.5);
    for (int row = 0; row < 3; ++row)
      frames += fmt::format("[{}, {}, {}, {}], ", r(0, row), -r(1, row), -r(2, row), view.camera.center()(row));
    frames += "[0, 0, 0, 1]]}";
  }
  write_text(folder / "transforms.json", fmt::format("{{\"frames\": [\n{}]}}\n", frames));
}

double from_ground(const Eigen::Vector3d& point) { return std::abs(point.z()); }
double from_walls(const Eigen::Vector3d& point) { return (3.0 - point.array().abs()).abs().minCoeff(); }

/// The shares of vertices within two voxels of the truth, and of the truth that three views see within two voxels of
/// a vertex.
struct Shares {
  double right = 0.0;
  double complete = 0.0;
};

Shares shares_of(const Scene& scene, const Surface& surface, const Mesh& mesh, double voxel,
                 double (*distance)(const Eigen::Vector3d&)) {
  const double near = 2.0 * voxel;
  const auto right = std::ranges::count_if(
      mesh.vertices, [&](const Vertex& vertex) { return distance(vertex.position.cast<double>()) <= near; });
  double found = 0.0;
  double all = 0.0;
  constexpr int kApart = 12;  // pixels
  for (const View& view : scene.views) {
    const Eigen::Vector3d center = view.camera.center();
    for (int y = kApart / 2; y < view.height; y += kApart)
      for (int x = kApart / 2; x < view.width; x += kApart) {
        const Eigen::Vector3d place = surface(center, view.camera.unproject(x, y, 1.0) - center);
        const auto seeing = std::ranges::count_if(scene.views, [&](const View& other) {
          const Eigen::Vector3d pixel = other.camera.project(place);
          return pixel.z() > 0 && pixel.x() > 2 && pixel.y() > 2 && pixel.x() < other.width - 3 &&
                 pixel.y() < other.height - 3;
        });
        if (seeing < 3) continue;
        all += 1.0;
        found += std::ranges::any_of(mesh.vertices, [&](const Vertex& vertex) {
          return (vertex.position.cast<double>() - place).squaredNorm() <= near * near;
        });
      }
  }
  return {static_cast<double>(right) / static_cast<double>(mesh.vertices.size()), found / all};
}

/// A run from the files, without a word beside them.
void expect_surface(const Scene& scene, const Surface& surface, double (*distance)(const Eigen::Vector3d&),
                    double least_complete) {
  const TemporaryFolder folder;
  write_scene(folder.path() / "scene", scene, surface);
  RunOptions options;
  const Scene found = read_scene(folder.path() / "scene", options.files).value();
  Workspace workspace = Workspace::open(folder.path() / "result").value();
  CpuBackend cpu({SimdLevel::kBaseline, 64, 16});
  Progress progress;
  Run run{found, options, cpu, workspace, progress};
  const auto done = reconstruct(run);
  ASSERT_TRUE(done) << done.error().message;
  const Mesh mesh = read_ply(workspace.mesh_path()).value();
  ASSERT_GT(mesh.vertices.size(), 500U);
  const Shares shares = shares_of(scene, surface, mesh, run.report.voxel_size, distance);
  EXPECT_GE(shares.right, 0.98);
  EXPECT_GE(shares.complete, least_complete);
  testing::Test::RecordProperty("right", fmt::format("{:.4f}", shares.right));
  testing::Test::RecordProperty("complete", fmt::format("{:.3f}", shares.complete));
}

TEST(CameraPath, OfADroneGivesTheGround) { expect_surface(small_images(strip(6)), on_ground, from_ground, 0.8); }

TEST(CameraPath, WithPansGivesTheWall) { expect_surface(small_images(pans(4)), on_walls, from_walls, 0.8); }

TEST(CameraPath, AroundARoomGivesTheWalls) { expect_surface(small_images(room(30), 8), on_walls, from_walls, 0.8); }

TEST(CameraPath, ThatTurnsOnTheSpotIsRefused) {
  const TemporaryFolder folder;
  write_scene(folder.path() / "scene", small_images(turn(4)), on_walls);
  const auto scene = read_scene(folder.path() / "scene", {});
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message.find("from about one place"), std::string::npos) << scene.error().message;
}

}  // namespace
}  // namespace quorum
