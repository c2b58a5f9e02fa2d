#include "engine/mesh/depth_mesh.h"

#include "shaders/layout.h"

namespace quorum {
namespace {

constexpr std::uint32_t kNoVertex = ~0U;

/// Hands out a vertex for each pixel that asks for one.
class PixelVertices {
 public:
  PixelVertices(const Camera& camera, const Grid<float>& depth, Mesh& mesh)
      : camera_(camera), depth_(depth), mesh_(mesh), vertex_of_pixel_(depth.width, depth.height, kNoVertex) {}

  std::uint32_t at(int x, int y) {
    std::uint32_t& vertex = vertex_of_pixel_.at(x, y);
    if (vertex == kNoVertex) {
      vertex = static_cast<std::uint32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back({.position = camera_.unproject(x, y, depth_.at(x, y)).cast<float>()});
    }
    return vertex;
  }

 private:
  const Camera& camera_;
  const Grid<float>& depth_;
  Mesh& mesh_;
  Grid<std::uint32_t> vertex_of_pixel_;
};

}  // namespace

Mesh depth_mesh(const Camera& camera, const Grid<float>& depth, const Grid<std::uint32_t>& cells) {
  Mesh mesh;
  PixelVertices vertices(camera, depth, mesh);
  for (int y = 0; y + 1 < depth.height; ++y) {
    for (int x = 0; x + 1 < depth.width; ++x) {
      const std::uint32_t cell = cells.at(x, y);
      const auto corner = [&](int number) { return vertices.at(x + (number & 1), y + (number >> 1)); };
      const auto add = [&](int a, int b, int c) { mesh.triangles.push_back({corner(a), corner(b), corner(c)}); };
      const bool split_03 = (cell & kCellSplitAlong03) != 0;
      if ((cell & kCellFirstTriangle) != 0) split_03 ? add(1, 0, 3) : add(0, 2, 1);
      if ((cell & kCellSecondTriangle) != 0) split_03 ? add(2, 3, 0) : add(3, 1, 2);
    }
  }
  return mesh;
}

}  // namespace quorum
