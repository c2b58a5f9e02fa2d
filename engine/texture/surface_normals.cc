#include "engine/texture/surface_normals.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/texture/project_mesh.h"

namespace quorum {
namespace {

using Triple = std::array<float, 3>;

float length_of(const Triple& vector) {
  return std::sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/// Of twice the triangle's area.
Triple outward(const Mesh& mesh, std::size_t triangle) {
  const auto& corners = mesh.triangles[triangle];
  double sides[2][3];
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      sides[side][axis] =
          double{mesh.vertices[corners[side + 1]].position[axis]} - double{mesh.vertices[corners[0]].position[axis]};
  Triple normal{};
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    normal[axis] = static_cast<float>(sides[0][next] * sides[1][last] - sides[0][last] * sides[1][next]);
  }
  return normal;
}

}  // namespace

double cosine_to(const SurfacePiece& piece, const Eigen::Vector3d& camera_center) {
  double along = 0;
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double to_camera = camera_center[axis] - double{piece.center[axis]};
    along += to_camera * double{piece.normal[axis]};
    square += to_camera * to_camera;
  }
  return square > 0 ? along / std::sqrt(square) : 0;
}

int smoothing_steps(const Mesh& mesh, const Scene& scene) {
  constexpr int kMostSteps = 12;
  if (mesh.triangles.empty() || scene.views.empty()) return 0;
  double center[3] = {};
  for (const Vertex& vertex : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) center[axis] += double{vertex.position[axis]};
  for (double& axis : center) axis /= static_cast<double>(mesh.vertices.size());
  std::vector<double> pixels;  // edges on the surface, scene units
  for (const View& view : scene.views) {
    const double depth = Projector(view.camera)(Eigen::Vector3d(center[0], center[1], center[2])).depth;
    pixels.push_back(std::abs(depth) / view.camera.intrinsics(0, 0));
  }
  std::ranges::sort(pixels);
  const double pixel = pixels[pixels.size() / 2];
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += length_of(outward(mesh, t)) / 2.0;
  const double triangles_a_pixel = pixel * pixel * static_cast<double>(mesh.triangles.size()) / area;
  constexpr double kReach = 2;  // pixels; steps spread as their square root
  return static_cast<int>(std::min<double>(kMostSteps, kReach * kReach * triangles_a_pixel));
}

std::vector<SurfacePiece> surface_pieces(const Mesh& mesh, const MeshLinks& links, int steps) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Triple> normals(count);
  std::vector<SurfacePiece> pieces(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    normals[t] = outward(mesh, t);
    pieces[t].area = length_of(normals[t]) / 2;
    for (int axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (const std::uint32_t vertex : mesh.triangles[t]) sum += double{mesh.vertices[vertex].position[axis]};
      pieces[t].center[axis] = static_cast<float>(sum / 3);
    }
  });
  std::vector<Triple> smoother(count);
  for (int step = 0; step < steps; ++step) {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
      Triple sum = normals[t];
      for (const std::uint32_t neighbor : links.neighbors[t])
        for (int axis = 0; axis < 3; ++axis) sum[axis] += neighbor == kNoTriangle ? 0.0F : normals[neighbor][axis];
      for (int axis = 0; axis < 3; ++axis) smoother[t][axis] = sum[axis] / 4;
    });
    std::swap(normals, smoother);
  }
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    const float length = length_of(normals[t]);
    for (int axis = 0; axis < 3; ++axis) pieces[t].normal[axis] = length > 0 ? normals[t][axis] / length : 0;
  });
  return pieces;
}

}  // namespace quorum
