// Points and neighbors of arrays are those of files: a COLMAP model beside arrays of the same.
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "engine/io/colmap_model.h"
#include "engine/io/ply.h"
#include "tests/host/api/api_scene.h"

namespace quorum {
namespace {

using v0::Results;
using v0::RunSettings;
using v0::Scene;

/// A temple whose surface is known, as a COLMAP model with points of it.
class ApiPoints : public ApiReconstruct {
 protected:
  std::filesystem::path model_folder() const { return below("colmap"); }

  /// Makes the scene, and the model: some 200 vertices of the truth are points, each said to be seen by three views
  /// that are not next to each other, so that other neighbors are chosen than by cameras alone.
  void write_model() {
    synthesize(8, 96);
    const auto truth = read_ply(scene() / "gt.ply");
    ASSERT_TRUE(truth);
    const Scene made = read();
    for (std::size_t i = 0; i < truth->vertices.size(); i += truth->vertices.size() / 200) {
      const auto id = static_cast<std::uint64_t>(model_.points.size() + 1);
      model_.points.push_back({id, truth->vertices[i].position.cast<double>(), {1, 2, 3}, {}});
    }
    std::filesystem::create_directories(model_folder() / "images");
    std::filesystem::create_directories(model_folder() / "sparse");
    for (int index = 0; index < made.view_count(); ++index) add_view(made.view(index));
    ASSERT_TRUE(write_colmap_model(model_folder() / "sparse", model_));
  }

  void add_view(const v0::ViewInfo& view) {
    const auto id = static_cast<std::uint32_t>(model_.images.size() + 1);
    const auto& k = view.camera.intrinsics;
    const auto* pinhole = &*std::ranges::find(colmap_camera_models(), "PINHOLE", &ColmapCameraModel::name);
    model_.cameras.push_back({id, pinhole, view.width, view.height, {k[0], k[4], k[2] + 0.5, k[5] + 0.5}});
    ColmapImage image;
    image.id = image.camera_id = id;
    image.name = view.image_name;
    const Eigen::Matrix3d rotation =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(view.camera.camera_from_world.data());
    const Eigen::Quaterniond turn(rotation);
    image.rotation = {turn.w(), turn.x(), turn.y(), turn.z()};
    image.translation = Eigen::Map<const Eigen::Vector3d>(view.camera.translation.data());
    for (ColmapPoint& point : model_.points) {
      if (point.id % 8 != (id - 1) % 8 && point.id % 8 != (id + 1) % 8 && point.id % 8 != (id + 2) % 8) continue;
      image.observations.push_back({{1.0, 1.0}, point.id});
      point.image_ids.push_back(id);
    }
    model_.images.push_back(image);
    std::filesystem::copy_file(scene() / view.image_name, model_folder() / "images" / view.image_name);
  }

  Scene read_model() const {
    auto read = Scene::read(model_folder());
    if (!read) throw std::runtime_error(read.error().message);
    return *read;
  }

  /// The model's photographs, cameras and points as arrays, without its box.
  OwnedArrays arrays_of_model(const Scene& from_files) const {
    OwnedArrays owned = arrays_of(from_files, model_folder() / "images");
    owned.arrays.bounds.reset();
    for (const ColmapPoint& point : model_.points) {
      v0::SparsePoint given;
      given.position = {point.position.x(), point.position.y(), point.position.z()};
      for (const std::uint32_t id : point.image_ids) given.views.push_back(static_cast<int>(id) - 1);
      owned.arrays.points.push_back(given);
    }
    return owned;
  }

  static Results run(const Scene& scene) {
    const auto results = v0::reconstruct(scene, options().set("neighbors", 2));
    if (!results) throw std::runtime_error(results.error().message);
    return *results;
  }

  ColmapModel model_;
};

/// The neighbors of each view, by name.
std::vector<std::vector<std::string>> neighbors_of(const Results& results) {
  std::vector<std::vector<std::string>> all;
  const auto report = nlohmann::json::parse(*results.report());
  for (const auto& view : report["depth_maps"]) all.push_back(view["neighbors"].get<std::vector<std::string>>());
  return all;
}

void expect_same(const Results& files, const Results& arrays) {
  EXPECT_EQ(files.scene().bounds(), arrays.scene().bounds());
  EXPECT_EQ(neighbors_of(files), neighbors_of(arrays));
  for (int view = 0; view < files.scene().view_count(); ++view) {
    const auto expected = files.depth_map(view);
    const auto found = arrays.depth_map(view);
    ASSERT_TRUE(expected && found);
    EXPECT_GT(std::ranges::count_if(expected->depth, [](float depth) { return depth > 0; }), 20) << view;
    EXPECT_TRUE(expected->depth == found->depth && expected->certainty == found->certainty) << view;
  }
  const auto expected = files.mesh();
  const auto found = arrays.mesh();
  ASSERT_TRUE(expected && found);
  EXPECT_TRUE(expected->positions == found->positions && expected->triangles == found->triangles);
}

TEST_F(ApiPoints, OfArraysChooseNeighborsAndBoundsAsThoseOfFiles) {
  write_model();
  const Scene from_files = read_model();
  OwnedArrays owned = arrays_of_model(from_files);
  const auto from_arrays = Scene::from_arrays(owned.arrays);
  ASSERT_TRUE(from_arrays) << from_arrays.error().message;
  const Results files = run(from_files);
  expect_same(files, run(*from_arrays));

  // Which points a view sees matters: without it other neighbors are chosen.
  for (v0::SparsePoint& point : owned.arrays.points) point.views.clear();
  const auto unseen = Scene::from_arrays(owned.arrays);
  ASSERT_TRUE(unseen) << unseen.error().message;
  EXPECT_NE(neighbors_of(run(*unseen)), neighbors_of(files));
}

TEST_F(ApiPoints, NeighborsOfArraysAreThoseOfFiles) {
  write_model();
  std::string lines;
  OwnedArrays owned = arrays_of_model(read_model());
  const auto count = static_cast<int>(owned.arrays.views.size());
  for (int view = 0; view < count; ++view) {
    std::vector<int>& neighbors = owned.arrays.views[static_cast<std::size_t>(view)].neighbors;
    neighbors = {(view + 1) % count, (view + count - 1) % count};
    lines += owned.arrays.views[static_cast<std::size_t>(view)].name + "\n";
    for (const int neighbor : neighbors)
      lines += owned.arrays.views[static_cast<std::size_t>(neighbor)].name + (neighbor == neighbors[0] ? ", " : "\n");
  }
  const Results chosen = run(read_model());
  std::filesystem::create_directories(model_folder() / "stereo");
  write_text(model_folder() / "stereo" / "patch-match.cfg", lines);
  const auto from_arrays = Scene::from_arrays(owned.arrays);
  ASSERT_TRUE(from_arrays) << from_arrays.error().message;
  const Results files = run(read_model());
  expect_same(files, run(*from_arrays));
  EXPECT_NE(neighbors_of(chosen), neighbors_of(files));
}

}  // namespace
}  // namespace quorum
