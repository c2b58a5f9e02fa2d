#include "tests/support/textured_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/io/write_image.h"

namespace quorum {

Mesh make_sphere_mesh(int rings) {
  Mesh mesh;
  const int sectors = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      const double polar = std::numbers::pi * ring / rings;
      const double around = 2 * std::numbers::pi * sector / sectors;
      Vertex vertex;
      vertex.position =
          Eigen::Vector3d(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar))
              .cast<float>();
      vertex.normal = vertex.position;
      vertex.confidence = 1;
      mesh.vertices.push_back(vertex);
    }
  const auto at = [&](int ring, int sector) { return static_cast<std::uint32_t>(ring * sectors + sector % sectors); };
  for (int ring = 0; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      if (ring > 0) mesh.triangles.push_back({at(ring, sector), at(ring + 1, sector), at(ring, sector + 1)});
      if (ring + 1 < rings)
        mesh.triangles.push_back({at(ring, sector + 1), at(ring + 1, sector), at(ring + 1, sector + 1)});
    }
  return mesh;
}

TexturedSphere::TexturedSphere(int around, int width, int height)
    : sphere(make_surrounding_sphere_scene(around, width, height, 7)) {
  for (std::size_t i = 0; i < sphere.images.size(); ++i) {
    View& view = sphere.scene.views[i];
    view.image_path = folder_.path() / (view.name + ".png");
    EXPECT_TRUE(write_png(view.image_path, sphere.images[i]));
  }
}

}  // namespace quorum
