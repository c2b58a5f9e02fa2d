// Whole runs on a scene with sparse points: the same at any scale, and what is made of depth maps beside the mesh.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/io/colmap.h"
#include "engine/io/convert_scene.h"
#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "engine/io/write_image.h"
#include "engine/pipeline/colmap_workspace.h"
#include "engine/pipeline/cpu_backend.h"
#include "engine/pipeline/fuse_points.h"
#include "engine/pipeline/reconstruct.h"
#include "tests/support/sphere_scene.h"
#include "tests/support/test_support.h"

namespace quorum {
namespace {

/// A sphere before a few cameras, as a COLMAP scene on disk, with points on its surface. scale: of all lengths; center:
/// of the sphere.
void write_sphere(const std::filesystem::path& folder, double scale,
                  const Eigen::Vector3d& center = Eigen::Vector3d::Zero()) {
  const SphereScene sphere = make_sphere_scene(5, 96, 72, false, 4);
  std::filesystem::create_directories(folder / "images");
  std::filesystem::create_directories(folder / "sparse");
  ColmapModel model;
  for (std::size_t i = 0; i < sphere.images.size(); ++i) {
    const View& view = sphere.scene.views[i];
    const Eigen::Matrix3d& k = view.camera.intrinsics;
    const auto id = static_cast<std::uint32_t>(i + 1);
    const std::string name = std::to_string(i) + ".png";
    ASSERT_TRUE(write_png(folder / "images" / name, sphere.images[i]));
    model.cameras.push_back({id, &colmap_camera_models()[1], 96, 72, {k(0, 0), k(1, 1), k(0, 2) + 0.5, k(1, 2) + 0.5}});
    const Eigen::Quaterniond q(view.camera.camera_from_world);
    model.images.push_back({id,
                            {q.w(), q.x(), q.y(), q.z()},
                            scale * view.camera.translation - q.toRotationMatrix() * center,
                            id,
                            name,
                            {}});
  }
  for (std::uint64_t id = 1; id <= 400; ++id) {
    const double z = 1.0 - 2.0 * static_cast<double>(id) / 401.0;
    const double turn = 2.4 * static_cast<double>(id);
    const Eigen::Vector3d point(std::cos(turn) * std::sqrt(1 - z * z), z, std::sin(turn) * std::sqrt(1 - z * z));
    ColmapPoint entry{id, scale * point + center, {1, 2, 3}, {}};
    for (std::size_t i = 0; i < sphere.images.size(); ++i) {
      const Camera& camera = sphere.scene.views[i].camera;
      if ((camera.center() - point).dot(point) < 0.3) continue;  // seen from behind, or aslant
      model.images[i].observations.push_back({camera.project(point).head<2>().array() + 0.5, id});
      entry.image_ids.push_back(static_cast<std::uint32_t>(i + 1));
    }
    if (entry.image_ids.size() >= 2) model.points.push_back(entry);
  }
  for (ColmapImage& image : model.images)
    std::erase_if(image.observations, [&](const ColmapObservation& seen) {
      return std::ranges::count(model.points, seen.point_id, &ColmapPoint::id) == 0;
    });
  ASSERT_TRUE(write_colmap_model(folder / "sparse", model));
}

struct Result {
  TemporaryFolder folder;
  Scene scene;
  RunOptions options;
  Workspace workspace = Workspace::open(folder.path() / "result").value();
  Mesh mesh;
  Progress progress;

  Run open(Backend& backend) { return {scene, options, backend, workspace, progress}; }

  explicit Result(double scale, WindowModel model = WindowModel::kSlanted,
                  const Eigen::Vector3d& center = Eigen::Vector3d::Zero(), const RunOptions& given = {})
      : options(given) {
    options.sweep.window_model = model;
    write_sphere(folder.path() / "scene", scale, center);
    scene = read_scene(folder.path() / "scene", options.files).value();
    CpuBackend cpu({SimdLevel::kBaseline, 64, 16});
    Run run = open(cpu);
    reconstruct(run).value();
    mesh = read_ply(workspace.mesh_path()).value();
  }
};

TEST(PointScene, MeshIsTheSameAtAnyScale) {
  const Result one(1.0);
  ASSERT_GT(one.mesh.triangles.size(), 1000U);
  // Powers of two change no digit of any float.
  for (const double scale : {1024.0, 1.0 / 1024.0}) {
    const Result scaled(scale);
    ASSERT_EQ(scaled.mesh.triangles, one.mesh.triangles) << scale;
    for (std::size_t i = 0; i < one.mesh.vertices.size(); ++i)
      ASSERT_EQ(scaled.mesh.vertices[i].position, static_cast<float>(scale) * one.mesh.vertices[i].position) << scale;
  }
  // Others round otherwise, and some depths tip over to the next plane. Not with slanted windows, where a pixel that
  // tips over hands its plane on to others.
  const Result flat(1.0, WindowModel::kPlane);
  for (const double scale : {1000.0, 0.001}) {
    const Result scaled(scale, WindowModel::kPlane);
    const auto expected = static_cast<double>(flat.mesh.triangles.size());
    EXPECT_NEAR(static_cast<double>(scaled.mesh.triangles.size()), expected, 0.01 * expected) << scale;
    EXPECT_NEAR(scaled.scene.bounds.size().norm(), scale * flat.scene.bounds.size().norm(), 1e-9 * scale);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Vector3f expected_sum = Eigen::Vector3f::Zero();
    for (const Vertex& vertex : scaled.mesh.vertices) sum += vertex.position / static_cast<float>(scale);
    for (const Vertex& vertex : flat.mesh.vertices) expected_sum += vertex.position;
    EXPECT_LT((sum / static_cast<float>(scaled.mesh.vertices.size()) -
               expected_sum / static_cast<float>(flat.mesh.vertices.size()))
                  .norm(),
              0.002F)
        << scale;
  }
}

const Eigen::Vector3d kUtm(500000.0, 4600000.0, 150.0);
const Eigen::Vector3d kEarthCentered(-2430000.5, -4702345.25, 3546587.125);

/// How far apart the vertices of two meshes are, in the coordinates of the files; infinite if they are not as many.
double largest_distance(const Mesh& one, const Mesh& two, const Eigen::Vector3d& two_from_one) {
  double largest = one.vertices.size() == two.vertices.size() ? 0.0 : INFINITY;
  for (std::size_t i = 0; i < one.vertices.size() && std::isfinite(largest); ++i)
    largest = std::max(largest, (two.offset - two_from_one + two.vertices[i].position.cast<double>() -
                                 (one.offset + one.vertices[i].position.cast<double>()))
                                    .norm());
  return largest;
}

TEST(PointScene, MovedFarFromTheOriginItGivesTheSameMeshAndCloud) {
  RunOptions options;
  options.cloud = true;
  const Result one(1.0, WindowModel::kSlanted, Eigen::Vector3d::Zero(), options);
  ASSERT_GT(one.mesh.triangles.size(), 1000U);
  EXPECT_EQ(one.mesh.offset, Eigen::Vector3d::Zero());
  EXPECT_EQ(read_file(one.workspace.mesh_path()).value().find("double"), std::string::npos);
  const Mesh cloud = read_ply(one.workspace.cloud_path()).value();
  constexpr double kHundredthOfVoxel = 0.0002;  // a pixel covers about 0.02
  for (const Eigen::Vector3d& center : {kUtm, kEarthCentered}) {
    const Result moved(1.0, WindowModel::kSlanted, center, options);
    EXPECT_LT((moved.scene.offset - center).norm(), 10.0);
    const double off = largest_distance(one.mesh, moved.mesh, center);
    EXPECT_LT(off, kHundredthOfVoxel);
    RecordProperty(center == kUtm ? "utm_voxels" : "earth_centered_voxels",
                   fmt::format("{:.1e}", 0.01 * off / kHundredthOfVoxel));
    EXPECT_LT(largest_distance(cloud, read_ply(moved.workspace.cloud_path()).value(), center), kHundredthOfVoxel);
    const std::string header = read_file(moved.workspace.mesh_path()).value().substr(0, 200);
    EXPECT_NE(header.find("property double x"), std::string::npos) << header;
  }
}

TEST(PointScene, BoundsAndLocalResultsOfAFarSceneFollowItsOffset) {
  RunOptions options;
  options.files.bounds = Bounds{kUtm.array() - 1.05, kUtm.array() + 1.05};
  options.frame = PlyFrame::kLocal;
  options.colmap = true;
  const Result far(1.0, WindowModel::kSlanted, kUtm, options);
  EXPECT_LT((far.scene.bounds.center() + far.scene.offset - kUtm).norm(), 1e-6);
  EXPECT_NEAR(far.scene.bounds.size().x(), 2.1, 1e-6);
  const std::string header = read_file(far.workspace.mesh_path()).value().substr(0, 200);
  EXPECT_NE(header.find("comment offset 5"), std::string::npos) << header;
  EXPECT_EQ(header.find("double"), std::string::npos) << header;
  for (const Vertex& vertex : far.mesh.vertices)
    ASSERT_LT((vertex.position.cast<double>() + far.mesh.offset - kUtm).norm(), 2.0);
  // With the frame of the files, the workspace for COLMAP is where the scene was.
  const Scene local = read_scene(far.workspace.colmap_path(), {}).value();
  EXPECT_EQ(local.offset, Eigen::Vector3d::Zero());
  options.frame = PlyFrame::kWorld;
  const Result world(1.0, WindowModel::kSlanted, kUtm, options);
  const Scene back = read_scene(world.workspace.colmap_path(), {}).value();
  EXPECT_EQ(back.offset, world.scene.offset);
  for (std::size_t i = 0; i < back.views.size(); ++i)
    EXPECT_LT((back.views[i].camera.center() - world.scene.views[i].camera.center()).norm(), 1e-7) << i;
}

TEST(PointScene, CloudLiesOnTheSurfaceWithItsNormals) {
  Result result(1.0);
  CpuBackend cpu;
  auto run = result.open(cpu);
  const Mesh cloud = fuse_points(run).value();
  ASSERT_GT(cloud.vertices.size(), 500U);
  std::size_t near = 0;
  std::size_t right = 0;
  for (const Vertex& vertex : cloud.vertices) {
    const float radius = vertex.position.norm();
    near += std::abs(radius - 1.0F) < 0.03F ? 1 : 0;
    right += vertex.normal.dot(vertex.position) / radius > 0.9F ? 1 : 0;
    EXPECT_GT(vertex.confidence, 0.0F);
  }
  result.options.cloud_views = 4;
  const std::size_t agreed = fuse_points(run).value().vertices.size();
  EXPECT_LT(agreed, cloud.vertices.size() * 9 / 10);
  EXPECT_GT(agreed, 100U);
  EXPECT_GT(near, cloud.vertices.size() * 9 / 10);
  EXPECT_GT(right, cloud.vertices.size() * 9 / 10);
}

TEST(PointScene, ColmapWorkspaceReadsAsTheSameScene) {
  Result result(1.0);
  CpuBackend cpu;
  auto run = result.open(cpu);
  const auto folder = run.workspace.colmap_path();
  const auto written = write_colmap_workspace(run);
  ASSERT_TRUE(written) << written.error().message;
  const Scene again = read_scene(folder, {}).value();
  ASSERT_EQ(again.views.size(), run.scene.views.size());
  ASSERT_EQ(again.points.size(), run.scene.points.size());
  EXPECT_EQ(again.points[7].views, run.scene.points[7].views);
  for (int i = 0; i < 5; ++i) {
    const View& view = again.views[static_cast<std::size_t>(i)];
    const View& expected = run.scene.views[static_cast<std::size_t>(i)];
    EXPECT_LT((view.camera.camera_from_world - expected.camera.camera_from_world).norm(), 1e-14);
    EXPECT_EQ(view.camera.intrinsics, expected.camera.intrinsics);
    EXPECT_EQ(view.neighbors, select_views(run.scene, i, run.options.views));
    EXPECT_EQ(read_file(view.image_path).value(), read_file(expected.image_path).value());

    const Grid<float> map = run.workspace.load_depth(expected.name, 96, 72).value();
    const std::string depth =
        read_file(folder / "stereo/depth_maps" / (expected.image_name + ".geometric.bin")).value();
    ASSERT_TRUE(depth.starts_with("96&72&1&"));
    EXPECT_EQ(std::memcmp(depth.data() + 8, map.values.data(), 96 * 72 * 4), 0);
    const std::string normals =
        read_file(folder / "stereo/normal_maps" / (expected.image_name + ".geometric.bin")).value();
    ASSERT_TRUE(normals.starts_with("96&72&3&"));
    ASSERT_EQ(normals.size(), 8U + 96U * 72U * 12U);
    float z = 0.0F;
    const std::size_t middle = 36 * 96 + 48;
    std::memcpy(&z, normals.data() + 8 + 4 * (2 * 96 * 72 + middle), 4);
    EXPECT_LT(z, -0.9F) << "the middle of the sphere looks at the camera";
  }
  EXPECT_EQ(read_file(folder / "stereo/fusion.cfg").value(), "0.png\n1.png\n2.png\n3.png\n4.png\n");
}

TEST(PointScene, CloudAndWorkspaceKeepTheBudget) {
  Result result(1.0);
  result.options.memory_bytes = 1 << 20;  // less than the process holds already
  CpuBackend cpu;
  auto run = result.open(cpu);
  const auto cloud = fuse_points(run);
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().kind, ErrorKind::kMemory);
  EXPECT_TRUE(cloud.error().message.starts_with("fusing points needs ")) << cloud.error().message;
  const auto written = write_colmap_workspace(run);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::kMemory);
  EXPECT_TRUE(written.error().message.starts_with("writing for COLMAP needs ")) << written.error().message;
  EXPECT_FALSE(std::filesystem::exists(run.workspace.colmap_path()));
}

/// The cameras of a scene, and its depth maps in a given box, of neighbors by angle.
std::vector<DepthMap> depth_maps_of(const Scene& scene, const std::filesystem::path& output) {
  RunOptions options;
  options.views.rule = ViewRule::kAngle;
  options.saved_maps = SavedMaps::kAll;
  const Workspace workspace = Workspace::open(output).value();
  CpuBackend cpu({SimdLevel::kBaseline, 64, 16});
  Progress progress;
  quorum::Run run{scene, options, cpu, workspace, progress};
  reconstruct(run, {.certainties = false, .mesh = false}).value();
  std::vector<DepthMap> maps;
  for (const View& view : scene.views)
    maps.push_back(workspace.load_depth_map(view.name, view.width, view.height).value());
  return maps;
}

TEST(PointScene, AllFormatsGiveTheSameDepthMapsToTheLastBit) {
  const TemporaryFolder folder;
  write_sphere(folder.path() / "source", 1.0);
  const Scene source = read_scene(folder.path() / "source", {}).value();
  std::vector<Scene> scenes;
  for (const auto& [name, format] : {std::pair{"colmap", ConvertedFormat::kColmap},
                                     {"text", ConvertedFormat::kColmapText},
                                     {"mvsnet", ConvertedFormat::kMvsnet},
                                     {"transforms", ConvertedFormat::kTransforms}}) {
    std::filesystem::create_directories(folder.path() / name);
    const auto converted = convert_scene(folder.path() / name, source, format);
    ASSERT_TRUE(converted) << converted.error().message;
    SceneOptions options;
    options.roi = folder.path() / name / "bounds.txt";
    scenes.push_back(read_scene(folder.path() / name, options).value());
  }
  EXPECT_EQ(scenes[1].points.size(), source.points.size());
  EXPECT_EQ(scenes[0].points[9].position, source.points[9].position);
  EXPECT_EQ(scenes[1].points[9].views, source.points[9].views);
  for (int view = 0; view < 5; ++view)
    EXPECT_EQ(select_views(scenes[2], view, {}), select_views(scenes[0], view, {})) << "pair.txt by points";

  const std::vector<DepthMap> expected = depth_maps_of(scenes[0], folder.path() / "out0");
  ASSERT_GT(std::ranges::count_if(expected[2].depth.values, [](float depth) { return depth > 0; }), 1000);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    EXPECT_EQ(scenes[i].bounds.low, source.bounds.low);
    EXPECT_EQ(scenes[i].bounds.high, source.bounds.high);
    ASSERT_EQ(scenes[i].views.size(), 5U);
    for (std::size_t view = 0; view < 5; ++view) {
      const Camera& camera = scenes[i].views[view].camera;
      EXPECT_EQ(camera.intrinsics, scenes[0].views[view].camera.intrinsics) << i;
      EXPECT_EQ(camera.camera_from_world, scenes[0].views[view].camera.camera_from_world) << i;
      EXPECT_EQ(camera.translation, scenes[0].views[view].camera.translation) << i;
      EXPECT_EQ(camera.intrinsics, source.views[view].camera.intrinsics);
      EXPECT_LT((camera.camera_from_world - source.views[view].camera.camera_from_world).cwiseAbs().maxCoeff(), 2e-15);
      EXPECT_LT((camera.translation - source.views[view].camera.translation).norm(), 1e-14);
      EXPECT_EQ(read_file(scenes[i].views[view].image_path).value(), read_file(source.views[view].image_path).value());
    }
    const std::vector<DepthMap> maps = depth_maps_of(scenes[i], folder.path() / ("out" + std::to_string(i)));
    for (std::size_t view = 0; view < 5; ++view) {
      EXPECT_EQ(maps[view].depth.values, expected[view].depth.values) << i << " view " << view;
      EXPECT_EQ(maps[view].correlation.values, expected[view].correlation.values) << i << " view " << view;
      EXPECT_EQ(maps[view].confidence.values, expected[view].confidence.values) << i << " view " << view;
    }
  }
}

TEST(PointScene, WorkspaceOfASceneWithoutPointsGetsSome) {
  Result result(1.0);
  result.scene.points.clear();
  CpuBackend cpu;
  auto run = result.open(cpu);
  write_colmap_workspace(run).value();
  const ColmapModel model = read_colmap_model(run.workspace.colmap_path() / "sparse").value();
  ASSERT_GT(model.points.size(), 50U);
  EXPECT_GT(std::ranges::count_if(model.points, [](const ColmapPoint& point) { return point.image_ids.size() >= 3; }),
            20);
}

}  // namespace
}  // namespace quorum
