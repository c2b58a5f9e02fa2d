#include "engine/render/render.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <array>
#include <limits>

namespace quorum {
namespace {

using Shading = RenderOptions::Shading;

constexpr int kWidth = 40;
constexpr int kHeight = 30;
constexpr Rgba kWhite = make_rgb(255, 255, 255);

Camera test_camera(double scale = 1) {
  Camera camera;
  camera.intrinsics << 50, 0, 18.5, 0, 52, 14.25, 0, 0, 1;
  camera.camera_from_world = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  camera.translation = scale * Eigen::Vector3d(0.3, -0.2, 0.5);
  return camera;
}

/// The world triangle of three pixels with depths, (x, y, depth) each.
Mesh triangle_at(const Camera& camera, const std::array<Eigen::Vector3d, 3>& pixels_and_depths) {
  Mesh mesh;
  for (const Eigen::Vector3d& p : pixels_and_depths)
    mesh.vertices.push_back({.position = camera.unproject(p.x(), p.y(), p.z()).cast<float>()});
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// A front face lists its corners counterclockwise as the picture is seen.
const std::array<Eigen::Vector3d, 3> kFront = {Eigen::Vector3d{5.3, 3.1, 2}, {8.2, 26.7, 3}, {33.6, 12.9, 4}};
const std::array<Eigen::Vector3d, 3> kBack = {kFront[0], kFront[2], kFront[1]};

ColorImage render(const Mesh& mesh, const Camera& camera, RenderOptions options = {}) {
  return render_mesh(mesh, camera, kWidth, kHeight, options).value();
}

/// True if the sample lies inside the pixels' triangle (kFront's order).
bool is_inside(const std::array<Eigen::Vector3d, 3>& corners, double x, double y) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = corners[i];
    const Eigen::Vector3d& b = corners[(i + 1) % 3];
    if ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x()) > 0) return false;
  }
  return true;
}

/// How many of the four samples of a pixel lie inside.
int samples_inside(const std::array<Eigen::Vector3d, 3>& corners, int x, int y) {
  int count = 0;
  for (const double dy : {-0.25, 0.25})
    for (const double dx : {-0.25, 0.25}) count += is_inside(corners, x + dx, y + dy) ? 1 : 0;
  return count;
}

std::uint32_t brightness(Rgba pixel) { return red_of(pixel) + green_of(pixel) + blue_of(pixel); }

TEST(RenderMesh, ATriangleCoversThePixelsInsideItsProjection) {
  const Camera camera = test_camera();
  Mesh mesh = triangle_at(camera, kFront);
  for (Vertex& vertex : mesh.vertices) vertex.color = make_rgb(0, 100, 40);
  const ColorImage image = render(mesh, camera, {.shading = Shading::kColor});
  std::array<int, 5> pixels_with{};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int inside = samples_inside(kFront, x, y);
      ++pixels_with[static_cast<std::size_t>(inside)];
      const auto mix = [&](int surface) { return (surface * inside + 255 * (4 - inside)) / 4.0; };
      EXPECT_NEAR(red_of(image.at(x, y)), mix(0), 0.51) << x << ' ' << y;
      EXPECT_NEAR(green_of(image.at(x, y)), mix(100), 0.51) << x << ' ' << y;
      EXPECT_NEAR(blue_of(image.at(x, y)), mix(40), 0.51) << x << ' ' << y;
    }
  for (const int count : pixels_with) EXPECT_GT(count, 3) << "each coverage occurs";
}

TEST(RenderMesh, BackFacesAreBluer) {
  const Camera camera = test_camera();
  const Rgba front = render(triangle_at(camera, kFront), camera).at(15, 14);
  const Rgba back = render(triangle_at(camera, kBack), camera).at(15, 14);
  EXPECT_LE(blue_of(front), red_of(front));
  EXPECT_GT(blue_of(back), red_of(back) * 3 / 2);
  EXPECT_EQ(blue_of(back), blue_of(front)) << "not lit as the side that is seen";
}

TEST(RenderMesh, TheNearerSurfaceHidesTheOther) {
  const Camera camera = test_camera();
  Mesh mesh = triangle_at(camera, {Eigen::Vector3d{-50, -50, 9}, {-50, 200, 9}, {200, -50, 9}});
  const Mesh near = triangle_at(camera, kFront);
  for (Vertex& vertex : mesh.vertices) vertex.color = make_rgb(255, 0, 0);
  for (Vertex vertex : near.vertices) {
    vertex.color = make_rgb(0, 255, 0);
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles.push_back({3, 4, 5});
  const ColorImage image = render(mesh, camera, {.shading = Shading::kColor});
  EXPECT_EQ(image.at(15, 14), make_rgb(0, 255, 0));
  EXPECT_EQ(image.at(1, 1), make_rgb(255, 0, 0));
}

TEST(RenderMesh, WhatLiesBehindTheCameraIsNotSeen) {
  const Camera camera = test_camera();
  std::array<Eigen::Vector3d, 3> behind = kFront;
  for (Eigen::Vector3d& corner : behind) corner.z() = -corner.z();
  EXPECT_EQ(render(triangle_at(camera, behind), camera), ColorImage(kWidth, kHeight, kWhite));
}

TEST(RenderMesh, ConfidenceIsBrighterWhereItIsHigher) {
  const Camera camera = test_camera();
  Mesh mesh = triangle_at(camera, kFront);
  std::uint32_t darker = 0;
  for (const float confidence : {0.0F, 0.5F, 1.0F, 1.5F, 2.0F}) {
    for (Vertex& vertex : mesh.vertices) vertex.confidence = confidence;
    const Rgba pixel = render(mesh, camera, {.shading = Shading::kConfidence, .full_confidence = 2}).at(15, 14);
    EXPECT_GT(brightness(pixel), darker) << confidence;
    darker = brightness(pixel);
  }
  mesh.vertices[0].confidence = mesh.vertices[1].confidence = 0;
  const ColorImage image = render(mesh, camera, {.shading = Shading::kConfidence});
  EXPECT_LT(brightness(image.at(8, 14)), brightness(image.at(20, 13)));
  EXPECT_LT(brightness(image.at(20, 13)), brightness(image.at(30, 13)));
}

TEST(RenderMesh, NormalsAreColorsInCameraAxes) {
  const Camera camera = test_camera();
  Mesh mesh = triangle_at(camera, kFront);
  for (Vertex& vertex : mesh.vertices)
    vertex.normal = (camera.camera_from_world.transpose() * Eigen::Vector3d(0.6, -0.8, 0)).cast<float>();
  const Rgba pixel = render(mesh, camera, {.shading = Shading::kNormal}).at(15, 14);
  EXPECT_NEAR(red_of(pixel), 1.6 * 127.5, 1);
  EXPECT_NEAR(green_of(pixel), 1.8 * 127.5, 1);
  EXPECT_NEAR(blue_of(pixel), 127.5, 1);
}

TEST(RenderMesh, VerticesWithoutNormalsAreLitByTheirTriangle) {
  const Camera camera = test_camera();
  Mesh mesh = triangle_at(camera, kFront);
  const ColorImage flat = render(mesh, camera);
  const Eigen::Vector3f edge = mesh.vertices[1].position - mesh.vertices[0].position;
  const Eigen::Vector3f normal = edge.cross(mesh.vertices[2].position - mesh.vertices[0].position).normalized();
  for (Vertex& vertex : mesh.vertices) vertex.normal = normal;
  const ColorImage smooth = render(mesh, camera);
  EXPECT_NEAR(brightness(flat.at(15, 14)), brightness(smooth.at(15, 14)), 3);
  EXPECT_NE(flat.at(15, 14), kWhite);
}

TEST(RenderMesh, TheUnitOfTheSceneDoesNotMatter) {
  const auto picture_in = [](double unit) {
    std::array<Eigen::Vector3d, 3> corners = kFront;
    for (Eigen::Vector3d& corner : corners) corner.z() *= unit;
    return render(triangle_at(test_camera(unit), corners), test_camera(unit));
  };
  const ColorImage meters = picture_in(1);
  for (const double unit : {1e-15, 1e15}) {
    const ColorImage image = picture_in(unit);
    for (std::size_t i = 0; i < image.values.size(); ++i)
      EXPECT_NEAR(brightness(image.values[i]), brightness(meters.values[i]), 3);
  }
}

TEST(RenderMesh, OneThreadGivesTheSamePicture) {
  const Camera camera = test_camera();
  const Mesh mesh = triangle_at(camera, kFront);
  const ColorImage parallel = render(mesh, camera);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(render(mesh, camera), parallel);
}

TEST(RenderMesh, EmptyMeshesCloudsAndBrokenTrianglesAreWhite) {
  const ColorImage white(kWidth, kHeight, kWhite);
  const Camera camera = test_camera();
  EXPECT_EQ(render(Mesh{}, camera), white);
  Mesh mesh = triangle_at(camera, kFront);
  mesh.vertices[1].position.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(render(mesh, camera), white);
  mesh.triangles.clear();
  EXPECT_EQ(render(mesh, camera), white);
  EXPECT_TRUE(render_mesh(mesh, camera, 0, 0, {}).value().empty());
}

TEST(RenderOptions, WhatIsOutOfRangeIsNamed) {
  const auto rendered = render_mesh(Mesh{}, test_camera(), 4, 4, {.full_confidence = -1});
  ASSERT_FALSE(rendered.has_value());
  EXPECT_EQ(rendered.error().kind, ErrorKind::kUsage);
  EXPECT_EQ(rendered.error().message.find("full_confidence: "), 0U);
}

}  // namespace
}  // namespace quorum
