#include "engine/texture/texture_mesh.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "engine/io/write_image.h"
#include "engine/render/compare_pictures.h"
#include "engine/render/render.h"
#include "tests/support/textured_sphere.h"

namespace quorum {
namespace {

constexpr int kAround = 8;

const TexturedSphere& input() {
  static const TexturedSphere kInput(kAround, 160, 160);
  return kInput;
}

Expected<Textured> texture(const Mesh& mesh, const Scene& scene, const TextureOptions& options = {},
                           const TextureWatch& watch = {}) {
  ImageStore images(scene, 0);
  return texture_mesh(mesh, scene, images, options, watch);
}

const Textured& textured_sphere() {
  static const Textured kTextured = texture(make_sphere_mesh(24), input().sphere.scene).value();
  return kTextured;
}

/// The mesh as a view sees it against the photograph of it.
PictureLikeness likeness(const TexturedMesh& mesh, std::size_t index) {
  const View& view = input().sphere.scene.views[index];
  RenderOptions options;
  options.shading = RenderOptions::Shading::kColor;
  Mask whole;
  const auto picture = render_textured(mesh, view.camera, view.width, view.height, options, &whole).value();
  return compare_pictures(picture, input().sphere.images[index], whole);
}

TEST(TextureMesh, ASphereLooksAsItsPhotographs) {
  const Textured& textured = textured_sphere();
  EXPECT_EQ(textured.counts.unseen, 0U);
  EXPECT_GE(textured.counts.views, 6U);
  EXPECT_LT(textured.counts.patches, 40U);
  for (std::size_t view = 0; view < input().sphere.images.size(); ++view) {
    const PictureLikeness like = likeness(textured.mesh, view);
    EXPECT_GT(like.pixels, 8000U) << view;
    EXPECT_GT(like.psnr, 31) << view;
    EXPECT_GT(like.ssim, 0.95) << view;
  }
}

TEST(TextureMesh, EveryTriangleIsThereOnceAndItsCoordinatesLieOnItsPage) {
  const TexturedMesh& mesh = textured_sphere().mesh;
  const Mesh plain = make_sphere_mesh(24);
  EXPECT_EQ(mesh.mesh.triangles.size(), plain.triangles.size());
  EXPECT_GT(mesh.mesh.vertices.size(), plain.vertices.size());  // split at seams
  ASSERT_EQ(mesh.first_triangles.size(), mesh.pages.size() + 2);
  EXPECT_EQ(mesh.coordinates.size(), mesh.mesh.vertices.size());
  for (const Eigen::Vector2f& place : mesh.coordinates) {
    EXPECT_GT(place.minCoeff(), 0);
    EXPECT_LT(place.maxCoeff(), 1);
  }
}

TEST(TextureMesh, AnyNumberOfThreadsGivesTheSame) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto again = texture(make_sphere_mesh(24), input().sphere.scene);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->mesh.pages, textured_sphere().mesh.pages);
  EXPECT_EQ(again->mesh.mesh.triangles, textured_sphere().mesh.mesh.triangles);
  EXPECT_EQ(again->mesh.coordinates, textured_sphere().mesh.coordinates);
}

TEST(TextureMesh, AMeshInOtherColorsThanThePhotographsIsRefused) {
  const TexturedMesh& textured = textured_sphere().mesh;
  Mesh mesh = textured.mesh;  // split at seams, which is no matter here
  const ColorImage& page = textured.pages.front();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Eigen::Vector2f place = textured.coordinates[v];
    mesh.vertices[v].color = page.at(static_cast<int>(place.x() * static_cast<float>(page.width)),
                                     static_cast<int>(place.y() * static_cast<float>(page.height)));
  }
  EXPECT_TRUE(texture(mesh, input().sphere.scene));
  for (Vertex& vertex : mesh.vertices)
    vertex.color =
        make_rgb((red_of(vertex.color) + 128) % 256, (green_of(vertex.color) + 128) % 256, blue_of(vertex.color));
  const auto refused = texture(mesh, input().sphere.scene);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
  EXPECT_NE(refused.error().message.find("other colors"), std::string::npos) << refused.error().message;
}

TEST(TextureMesh, WhatNoPhotographShowsKeepsTheColorOfItsVertices) {
  Scene front = input().sphere.scene;
  front.views.resize(1);
  const auto textured = texture(make_sphere_mesh(24), front);
  ASSERT_TRUE(textured) << textured.error().message;
  const std::uint32_t triangles = textured->mesh.first_triangles.back();
  EXPECT_EQ(textured->counts.unseen, textured->mesh.unseen_triangles());
  EXPECT_GT(textured->counts.unseen, triangles / 2);  // the far half, and what is seen at too flat an angle
  EXPECT_LT(textured->counts.unseen, triangles * 3 / 4);
  for (std::uint32_t v = textured->mesh.first_vertices[textured->mesh.pages.size()];
       v < textured->mesh.mesh.vertices.size(); ++v)
    EXPECT_EQ(textured->mesh.mesh.vertices[v].color, make_rgb(128, 128, 128));
}

TEST(TextureMesh, WhatStandsInFrontIsNotPaintedOnWhatIsBehind) {
  // A plate before the sphere as the first view sees it; that view alone could show the middle of the sphere.
  Scene front = input().sphere.scene;
  front.views.resize(1);
  Mesh mesh = make_sphere_mesh(24);
  const auto sphere_triangles = mesh.triangles.size();
  const Camera& camera = front.views[0].camera;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& [x, y] : {std::pair(40, 40), std::pair(40, 120), std::pair(120, 120), std::pair(120, 40)})
    mesh.vertices.push_back({.position = camera.unproject(x, y, 2).cast<float>()});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  const auto textured = texture(mesh, front);
  ASSERT_TRUE(textured);
  const auto open = texture(make_sphere_mesh(24), front);
  EXPECT_GT(textured->counts.unseen, open->counts.unseen + sphere_triangles / 8);
}

TEST(TextureMesh, APhotographOfAnotherExposureLeavesNoStep) {
  TexturedSphere dark(kAround, 160, 160);
  ColorImage& image = dark.sphere.images[2];
  for (Rgba& pixel : image.values)
    pixel = make_rgb(red_of(pixel) * 7 / 8, green_of(pixel) * 7 / 8, blue_of(pixel) * 7 / 8);
  ASSERT_TRUE(write_png(dark.sphere.scene.views[2].image_path, image));
  TextureOptions plain;
  plain.level = false;
  plain.band_pixels = 0;
  const auto leveled = texture(make_sphere_mesh(24), dark.sphere.scene);
  const auto stepped = texture(make_sphere_mesh(24), dark.sphere.scene, plain);
  ASSERT_TRUE(leveled && stepped);
  EXPECT_GT(likeness(leveled->mesh, 2).psnr, likeness(stepped->mesh, 2).psnr + 3);
}

TEST(TextureMesh, SmallPagesBecomeMany) {
  TextureOptions options;
  options.page_size = 256;
  const auto textured = texture(make_sphere_mesh(24), input().sphere.scene, options);
  ASSERT_TRUE(textured) << textured.error().message;
  EXPECT_GT(textured->mesh.pages.size(), 1U);
  for (const ColorImage& page : textured->mesh.pages) EXPECT_LE(std::max(page.width, page.height), 256);
  EXPECT_GT(likeness(textured->mesh, 1).psnr, 31);
}

TEST(TextureMesh, WhatCanNotBeTexturedIsRefused) {
  const Scene& scene = input().sphere.scene;
  Mesh cloud = make_sphere_mesh(4);
  cloud.triangles.clear();
  EXPECT_EQ(texture(cloud, scene).error().kind, ErrorKind::kInput);
  Mesh elsewhere = make_sphere_mesh(4);
  for (Vertex& vertex : elsewhere.vertices) vertex.position += Eigen::Vector3f(100, 100, 0);
  const auto unseen = texture(elsewhere, scene);
  ASSERT_FALSE(unseen);
  EXPECT_NE(unseen.error().message.find("no photograph shows"), std::string::npos);
  TextureWatch watch;
  watch.require = [](std::uint64_t, std::string_view what_for) {
    return what_for == "the pages of the texture" ? failure(ErrorKind::kMemory, "too much") : Expected<void>();
  };
  const auto large = texture(make_sphere_mesh(24), scene, {}, watch);
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().kind, ErrorKind::kMemory);
  Scene gone = scene;
  gone.views[3].image_path = "gone.png";
  const auto failed = texture(make_sphere_mesh(4), gone);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, ErrorKind::kInput);
  EXPECT_NE(failed.error().message.find("gone.png"), std::string::npos);
}

}  // namespace
}  // namespace quorum
