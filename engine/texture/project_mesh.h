// A mesh as a photograph shows it: vertices on a grid of 1/256 pixel, and the pixels of a triangle by integers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/scene/scene.h"

namespace quorum {

constexpr int kSubpixels = 256;  ///< steps of a projected position to a pixel

/// x, y, 1 ~ rows · point, in scalar double and a fixed order, so that every machine gets the same.
class Projector {
 public:
  explicit Projector(const Camera& camera);

  struct Place {
    double x = 0;  ///< pixels
    double y = 0;
    double depth = 0;  ///< scene units; the place is meaningless unless it is above 0
  };
  [[nodiscard]] Place operator()(const Eigen::Vector3d& point) const;

 private:
  double rows_[3][4];
};

/// Those of all views.
std::vector<Projector> view_projectors(const Scene& scene);

/// A projected vertex.
struct ProjectedVertex {
  std::int32_t x = 0;  ///< 1/256 pixel
  std::int32_t y = 0;
  std::uint32_t nearness = 0;  ///< 2^31 at the vertex that is nearest, falling with 1 / depth; 0 = not in the picture's
                               ///< reach: behind the camera, or very far from the frame
};

/// Whether it lies a pixel or more inside a frame.
inline bool is_in_frame(const ProjectedVertex& vertex, int width, int height) {
  const auto is_inside = [](std::int32_t at, int size) { return at >= kSubpixels && at <= (size - 2) * kSubpixels; };
  return vertex.nearness > 0 && is_inside(vertex.x, width) && is_inside(vertex.y, height);
}

/// All vertices of a mesh, and the scale of their nearness.
struct ProjectedMesh {
  std::vector<ProjectedVertex> vertices;
  double footprint = 0;  ///< what a depth changes, in shares of itself, while the place moves by a pixel at 45°
};
ProjectedMesh project_mesh(const Mesh& mesh, const View& view);

/// The place on the grid.
ProjectedVertex snap(const Projector::Place& place);

/// Pixels whose centers lie in a projected triangle or on its border. Exact: of triangles that share an edge none
/// leaves a pixel between them.
class TrianglePixels {
 public:
  TrianglePixels(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c);

  /// Twice the area, in (1/256 pixel)²; negative where the front is seen (corners counterclockwise, y down).
  [[nodiscard]] std::int64_t signed_area() const { return signed_area_; }
  /// The box of the pixels, cut to width × height; `grow` pixels more on each side.
  struct Box {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;  ///< both ends inclusive
  };
  [[nodiscard]] Box box(int width, int height, int grow = 0) const;
  /// Shares of the corners at a pixel, sum 1; some are below 0 outside. Without area the same for all.
  [[nodiscard]] std::array<double, 3> shares(int x, int y) const;
  [[nodiscard]] bool covers(int x, int y) const;
  /// The area, pixels.
  [[nodiscard]] double area() const {
    return static_cast<double>(signed_area_ < 0 ? -signed_area_ : signed_area_) / (2.0 * kSubpixels * kSubpixels);
  }

  /// Calls use(x, y, shares) for each pixel of the triangle within width × height.
  template <typename Use>
  void for_each(int width, int height, const Use& use) const {
    if (signed_area_ == 0) return;
    const Box range = box(width, height);
    for (int y = range.y0; y <= range.y1; ++y)
      for (int x = range.x0; x <= range.x1; ++x)
        if (covers(x, y)) use(x, y, shares(x, y));
  }

 private:
  /// Twice the area of the triangle of an edge and a pixel's center, positive inside.
  [[nodiscard]] std::int64_t edge(int i, int x, int y) const;

  std::array<std::int64_t, 3> x_;
  std::array<std::int64_t, 3> y_;
  std::int64_t signed_area_;
};

}  // namespace quorum
