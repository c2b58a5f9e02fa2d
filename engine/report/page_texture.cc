#include "engine/report/page_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/io/contact_sheet.h"
#include "engine/pipeline/texture_scene.h"
#include "engine/report/data_url.h"
#include "engine/scene/limit_image_size.h"

namespace quorum {
namespace {

constexpr int kPhotographSide = 1000;
constexpr int kPageSide = 4096;
constexpr double kPagePixels = 4e6;

/// Makes pages smaller, all by one factor, until they have no more pixels together than a page should hold.
void shrink(std::vector<ColorImage>& pages) {
  double pixels = 0;
  for (const ColorImage& page : pages) pixels += static_cast<double>(page.values.size());
  const double factor = std::sqrt(kPagePixels / std::max(pixels, kPagePixels));
  if (factor == 1) return;
  for (ColorImage& page : pages) page = scale_to_width(page, std::max(1, static_cast<int>(page.width * factor)));
}

}  // namespace

Expected<TexturedMesh> texture_for_page(const Mesh& mesh, const Scene& scene, const MemoryBudget& budget,
                                        Progress& progress) {
  TexturedMesh plain;
  plain.mesh = mesh;
  if (mesh.triangles.empty()) return plain;
  Scene small = scene;
  limit_image_size(small, kPhotographSide);
  TextureOptions options;
  options.page_size = kPageSide;
  auto textured = texture_scene(mesh, small, options, 0, budget, progress);
  if (!textured && textured.error().kind == ErrorKind::kStopped) return std::unexpected(textured.error());
  if (!textured) {
    progress.note(fmt::format("report.html shows the mesh without its texture: {}", textured.error().message));
    return plain;
  }
  shrink(textured->mesh.pages);
  return std::move(textured->mesh);
}

Expected<nlohmann::ordered_json> texture_json(const TexturedMesh& mesh) {
  if (mesh.pages.empty()) return nullptr;
  std::vector<std::uint16_t> coordinates;
  for (const Eigen::Vector2f& place : mesh.coordinates)
    for (const float share : place)
      coordinates.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * 65535.0F)));
  nlohmann::ordered_json pages = nlohmann::ordered_json::array();
  for (const ColorImage& page : mesh.pages) {
    QUORUM_ASSIGN(const auto url, data_url(page, page.width));
    pages.push_back(url);
  }
  return nlohmann::ordered_json{
      {"coordinates", base64_of(coordinates)}, {"pages", pages}, {"first_triangles", mesh.first_triangles}};
}

}  // namespace quorum
