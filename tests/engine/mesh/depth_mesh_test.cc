#include "engine/mesh/depth_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "engine/volume/range_surface.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

Mesh mesh_of_map(const View& view, const Grid<float>& depth, const FusionOptions& options = {}) {
  return depth_mesh(view.camera, depth,
                    range_surface(depth, make_range_surface_params(view.camera, depth.width, depth.height, options)));
}

/// Depth of the sphere at every pixel of a view.
Grid<float> sphere_map(const View& view) {
  Grid<float> depth(view.width, view.height);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) depth.at(x, y) = static_cast<float>(sphere_depth(view, x, y));
  return depth;
}

TEST(DepthMesh, LiesOnTheSurfaceAndFacesTheCamera) {
  const SphereScene sphere = make_sphere_scene(2, 90, 70, true, 1);
  for (const View& view : sphere.scene.views) {  // the second is upside down
    const Mesh mesh = mesh_of_map(view, sphere_map(view));
    ASSERT_GT(mesh.triangles.size(), 2000U);
    for (const Vertex& vertex : mesh.vertices) EXPECT_NEAR(vertex.position.norm(), kSphereRadius, 1e-4);
    const Eigen::Vector3f center = view.camera.center().cast<float>();
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3f& p = mesh.vertices[a].position;
      const Eigen::Vector3f normal = (mesh.vertices[b].position - p).cross(mesh.vertices[c].position - p);
      EXPECT_GT(normal.dot(center - p), 0.0F);
    }
  }
}

TEST(DepthMesh, HasATriangleForEachBitOfTheCells) {
  const SphereScene sphere = make_sphere_scene(2, 90, 70, false, 1);
  const View& view = sphere.scene.views[0];
  Grid<float> depth = sphere_map(view);
  for (std::size_t pixel = 0; pixel < depth.values.size(); pixel += 7) depth.values[pixel] = 0.0F;
  const auto cells = range_surface(depth, make_range_surface_params(view.camera, view.width, view.height, {}));
  std::size_t triangles = 0;
  int split_03 = 0;
  for (const std::uint32_t cell : cells.values) {
    triangles += (cell & kCellFirstTriangle) != 0 ? 1 : 0;
    triangles += (cell & kCellSecondTriangle) != 0 ? 1 : 0;
    split_03 += (cell & kCellSplitAlong03) != 0 ? 1 : 0;
  }
  ASSERT_GT(split_03, 100);
  const Mesh mesh = depth_mesh(view.camera, depth, cells);
  EXPECT_EQ(mesh.triangles.size(), triangles);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh.vertices.size());
}

TEST(DepthMesh, SinglePixelsAndEmptyMapsGiveNothing) {
  const SphereScene sphere = make_sphere_scene(2, 9, 9, false, 1);
  const View& view = sphere.scene.views[0];
  Grid<float> depth(9, 9);
  EXPECT_TRUE(mesh_of_map(view, depth).vertices.empty());
  depth.at(4, 4) = 3.0F;
  EXPECT_TRUE(mesh_of_map(view, depth).vertices.empty());
  EXPECT_TRUE(depth_mesh(view.camera, {}, {}).triangles.empty());
}

}  // namespace
}  // namespace quorum
