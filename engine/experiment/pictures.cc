#include "engine/experiment/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/evaluate/color_by_error.h"
#include "engine/experiment/experiment.h"
#include "engine/io/contact_sheet.h"
#include "engine/io/image_file.h"
#include "engine/io/preview.h"
#include "engine/io/write_image.h"
#include "engine/mesh/depth_mesh.h"
#include "engine/render/render.h"
#include "engine/volume/range_surface.h"

namespace quorum {
namespace {

using Shading = RenderOptions::Shading;

constexpr double kFullError = 0.001;     // drawn red, scene units
constexpr float kFullConfidence = 1.0F;  // drawn yellow

/// A part of an image, pixels.
struct Region {
  int x, y, width, height;
};

/// Where a view sees the bounds.
Region region_of(const View& view, const Bounds& bounds) {
  double left = view.width, top = view.height, right = 0, bottom = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d pixel = view.camera.project(bounds.corner(corner));
    if (pixel.z() <= 0) return {0, 0, view.width, view.height};
    left = std::min(left, pixel.x());
    top = std::min(top, pixel.y());
    right = std::max(right, pixel.x());
    bottom = std::max(bottom, pixel.y());
  }
  const auto cut = [](double value, int limit) { return static_cast<int>(std::clamp(value, 0.0, double{1} * limit)); };
  const int x = cut(left, view.width);
  const int y = cut(top, view.height);
  return {x, y, cut(std::ceil(right), view.width) - x, cut(std::ceil(bottom), view.height) - y};
}

/// Draws and writes pictures of one view.
class PictureWriter {
 public:
  PictureWriter(const View& view, const Bounds& bounds, int quarter_turns, std::filesystem::path folder)
      : view_(view), region_(region_of(view, bounds)), quarter_turns_(quarter_turns), folder_(std::move(folder)) {}

  [[nodiscard]] Expected<void> write(Picture picture, const ColorImage& image) const {
    const ColorImage part = crop(image, region_.x, region_.y, region_.width, region_.height);
    return write_png(folder_ / fmt::format("{}.png", to_string(picture)), turn_left(part, quarter_turns_));
  }

  [[nodiscard]] Expected<void> draw(Picture picture, const Mesh& mesh, Shading shading) const {
    const auto image = render_mesh(mesh, view_.camera, view_.width, view_.height, {shading, kFullConfidence});
    return image ? write(picture, *image) : std::unexpected(image.error());
  }

 private:
  const View& view_;
  Region region_;
  int quarter_turns_;
  std::filesystem::path folder_;
};

Expected<void> write_depth_pictures(const PictureWriter& writer, const View& view, const RunOptions& options,
                                    const Workspace& workspace) {
  if (!workspace.has_depth_map(view.name)) return {};
  QUORUM_ASSIGN(const auto map, workspace.load_depth_map(view.name, view.width, view.height));
  const auto cells =
      range_surface(map.depth, make_range_surface_params(view.camera, view.width, view.height, options.fusion));
  QUORUM_TRY(writer.draw(Picture::kDepth, depth_mesh(view.camera, map.depth, cells), Shading::kShaded));
  QUORUM_TRY(writer.write(Picture::kCorrelation, color_map_unit(map.correlation)));
  return writer.write(Picture::kConfidence, color_map_unit(map.confidence));
}

}  // namespace

Expected<void> write_pictures(const OpenScene& scene, const RunOptions& options, const Workspace& workspace,
                              const Mesh& mesh, const std::filesystem::path& folder) {
  const auto found = std::ranges::find(scene.scene.views, scene.source->figure_view, &View::name);
  const View& view = found != scene.scene.views.end() ? *found : scene.scene.views.front();
  const PictureWriter writer(view, scene.scene.bounds, scene.source->quarter_turns, folder);
  QUORUM_ASSIGN(const auto photo, read_image(view.image_path));
  QUORUM_TRY(writer.write(Picture::kPhoto, photo));
  QUORUM_TRY(write_depth_pictures(writer, view, options, workspace));
  for (const auto& [picture, shading] : {std::pair{Picture::kMesh, Shading::kShaded},
                                         {Picture::kColor, Shading::kColor},
                                         {Picture::kMeshConfidence, Shading::kConfidence}})
    QUORUM_TRY(writer.draw(picture, mesh, shading));
  if (!scene.truth) return {};
  QUORUM_ASSIGN(const auto colored, color_by_error(mesh, *scene.truth, kFullError));
  return writer.draw(Picture::kError, colored, Shading::kColor);
}

std::string_view to_string(Picture picture) {
  switch (picture) {
    case Picture::kPhoto:
      return "photo";
    case Picture::kDepth:
      return "depth";
    case Picture::kCorrelation:
      return "correlation";
    case Picture::kConfidence:
      return "confidence";
    case Picture::kMesh:
      return "mesh";
    case Picture::kColor:
      return "color";
    case Picture::kMeshConfidence:
      return "mesh-confidence";
    case Picture::kError:
      return "error";
  }
  return "";
}

}  // namespace quorum
