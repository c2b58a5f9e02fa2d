// Runs by the library give what the program gives.
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/io/ply.h"
#include "engine/io/write_image.h"
#include "engine/pipeline/workspace.h"
#include "tests/host/api/api_scene.h"

namespace quorum {
namespace {

using v0::ErrorKind;
using v0::Options;
using v0::Results;
using v0::RunSettings;
using v0::Scene;

/// The maps of the library are those that lie in the program's workspace.
void expect_same_maps(const Results& results, const std::filesystem::path& folder) {
  const Workspace program = Workspace::at(folder);
  for (int index = 0; index < results.scene().view_count(); ++index) {
    const v0::ViewInfo view = results.scene().view(index);
    const auto map = results.depth_map(index);
    ASSERT_TRUE(map) << map.error().message;
    const auto expected = program.load_depth_map(view.name, view.width, view.height);
    ASSERT_TRUE(expected) << expected.error().message;
    EXPECT_GT(std::ranges::count_if(map->depth, [](float depth) { return depth > 0; }), 100) << view.name;
    EXPECT_TRUE(map->depth == expected->depth.values) << view.name;
    EXPECT_TRUE(map->confidence == expected->confidence.values) << view.name;
    EXPECT_TRUE(map->correlation == expected->correlation.values) << view.name;
    const auto certainty = program.load_certainty(view.name, view.width, view.height);
    ASSERT_TRUE(certainty) << certainty.error().message;
    EXPECT_TRUE(map->certainty == certainty->values) << view.name;
    const auto normals = program.load_normals(view.name, view.width, view.height);
    ASSERT_TRUE(normals) << normals.error().message;
    std::vector<float> flat;
    for (const Eigen::Vector3f& normal : normals->values) flat.insert(flat.end(), normal.data(), normal.data() + 3);
    EXPECT_TRUE(map->normal == flat) << view.name;
  }
}

void expect_same_mesh(const Results& results, const std::filesystem::path& folder) {
  const auto expected = quorum::read_ply(folder / "mesh.ply");
  const auto mesh = results.mesh();
  ASSERT_TRUE(expected && mesh);
  ASSERT_EQ(mesh->vertex_count(), expected->vertices.size());
  ASSERT_EQ(mesh->triangle_count(), expected->triangles.size());
  ASSERT_GT(mesh->triangle_count(), 100U);
  for (std::size_t i = 0; i < expected->vertices.size(); ++i) {
    const Vertex& vertex = expected->vertices[i];
    ASSERT_EQ(mesh->positions[3 * i + 1], vertex.position.y());
    ASSERT_EQ(mesh->normals[3 * i + 2], vertex.normal.z());
    ASSERT_EQ(mesh->confidence[i], vertex.confidence);
    ASSERT_EQ(mesh->colors[3 * i], red_of(vertex.color));
    ASSERT_EQ(mesh->colors[3 * i + 2], blue_of(vertex.color));
  }
  for (std::size_t i = 0; i < expected->triangles.size(); ++i)
    ASSERT_EQ(mesh->triangles[3 * i + 2], expected->triangles[i][2]);
}

TEST_F(ApiReconstruct, FilesAndArraysGiveTheBytesOfTheProgram) {
  synthesize(8, 112);
  run_program("program");
  const Scene from_files = read();
  RunSettings settings;
  settings.workspace = below("library");
  const auto kept = v0::reconstruct(from_files, options(), settings);
  ASSERT_TRUE(kept) << kept.error().message;
  auto expected = files_below(below("program"));
  auto found = files_below(below("library"));
  ASSERT_EQ(expected.size(), 8U * 12U + 2U);
  expected.erase("run.json");
  EXPECT_EQ(found.erase("run.json"), 1U);
  EXPECT_TRUE(expected == found);
  EXPECT_EQ(kept->folder(), below("library"));

  OwnedArrays owned = arrays_of(from_files, scene());
  const auto from_arrays = Scene::from_arrays(owned.arrays);
  ASSERT_TRUE(from_arrays) << from_arrays.error().message;
  owned.pixels.clear();  // they may go
  const auto results = v0::reconstruct(*from_arrays, options());
  ASSERT_TRUE(results) << results.error().message;
  expect_same_maps(*results, below("program"));
  expect_same_mesh(*results, below("program"));
  const auto report = results->report();
  ASSERT_TRUE(report);
  EXPECT_EQ(nlohmann::json::parse(*report)["version"], v0::version());
}

TEST_F(ApiReconstruct, MasksOfArraysAreThoseOfFiles) {
  synthesize(8, 128);
  const Scene from_files = read();
  OwnedArrays owned = arrays_of(from_files, scene());
  std::filesystem::create_directory(below("masks"));
  std::vector<std::vector<std::uint8_t>> masks;
  for (v0::ViewArrays& view : owned.arrays.views) {
    const int width = view.image.width;
    const int height = view.image.height;
    ColorImage file(width, height);
    masks.emplace_back(static_cast<std::size_t>(width * height));
    for (int i = 0; i < width * height; ++i) {
      const bool in = i % width > width / 2;
      masks.back()[static_cast<std::size_t>(i)] = in ? 1 : 0;
      file.values[static_cast<std::size_t>(i)] = in ? make_rgb(255, 255, 255) : make_rgb(0, 0, 0);
    }
    view.mask = {masks.back().data(), width, height, 1};
    ASSERT_TRUE(write_png(below("masks") / (view.name + ".png"), file));
  }
  run_program("program", {"--masks", below("masks").string()});
  const auto from_arrays = Scene::from_arrays(owned.arrays);
  ASSERT_TRUE(from_arrays) << from_arrays.error().message;
  RunSettings settings;
  settings.mesh = false;
  const auto results = v0::reconstruct(*from_arrays, options(), settings);
  ASSERT_TRUE(results) << results.error().message;
  expect_same_maps(*results, below("program"));
  const auto map = results->depth_map(1);
  ASSERT_TRUE(map);
  for (int y = 0; y < map->height; ++y) EXPECT_EQ(map->depth[static_cast<std::size_t>(y * map->width + 3)], 0.0F);
}

TEST_F(ApiReconstruct, WorkspacesOpenAgain) {
  synthesize(8, 112);
  run_program("program");
  const auto results = Results::open(read(), below("program"));
  ASSERT_TRUE(results);
  expect_same_maps(*results, below("program"));
  expect_same_mesh(*results, below("program"));
  std::filesystem::remove(below("program") / "depth" / (results->scene().view(1).name + ".depth.json"));
  EXPECT_FALSE(results->has_depth_map(1));
  expect_error(results->depth_map(1), ErrorKind::kInput, {results->scene().view(1).name});
  expect_error(Results::open(read(), below("absent")), ErrorKind::kInput, {"absent", "no such folder"});
}

TEST_F(ApiReconstruct, TwoRunsAtOnceGiveTheSame) {
  synthesize(8, 80);
  const Scene scene = read();
  std::vector<v0::Mesh> meshes(2);
  std::vector<std::thread> threads;
  for (v0::Mesh& mesh : meshes)
    threads.emplace_back([&mesh, &scene] {
      const auto results = v0::reconstruct(scene, options());
      ASSERT_TRUE(results) << results.error().message;
      const auto made = results->mesh();
      ASSERT_TRUE(made) << made.error().message;
      mesh = *made;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(meshes[0].triangle_count(), 10U);
  EXPECT_TRUE(meshes[0].positions == meshes[1].positions);
  EXPECT_TRUE(meshes[0].triangles == meshes[1].triangles);
}

}  // namespace
}  // namespace quorum
