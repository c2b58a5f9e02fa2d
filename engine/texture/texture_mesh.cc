#include "engine/texture/texture_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/core/option_maker.h"
#include "engine/mesh/make_manifold.h"
#include "engine/texture/assemble.h"
#include "engine/texture/compare_colors.h"
#include "engine/texture/nearness_buffer.h"
#include "engine/texture/paint_pages.h"
#include "engine/texture/rate_triangles.h"
#include "engine/texture/seam_colors.h"

namespace quorum {
namespace {

/// What the phases share.
struct Texturing {
  const Mesh& mesh;
  const Scene& scene;
  ImageStore& images;
  const TextureOptions& options;
  const TextureWatch& watch;
};

/// Calls use(view, photograph) for each view that is wanted, in order.
template <typename Wanted, typename Use>
Expected<void> for_each_photograph(const Texturing& work, std::string_view stage, const Wanted& wanted,
                                   const Use& use) {
  work.watch.stage(stage, static_cast<int>(work.scene.views.size()));
  for (std::size_t view = 0; view < work.scene.views.size(); ++view) {
    if (wanted(view)) {
      QUORUM_ASSIGN(const auto photograph, work.images.image(static_cast<int>(view)));
      QUORUM_TRY(use(view, *photograph));
    }
    QUORUM_TRY(work.watch.step());
  }
  return {};
}

Expected<void> rate_all(const Texturing& work, const std::vector<SurfacePiece>& pieces, Candidates& candidates) {
  const auto all = [](std::size_t) { return true; };
  return for_each_photograph(
      work, "rating photographs", all, [&](std::size_t index, const ColorImage& photograph) -> Expected<void> {
        const View& view = work.scene.views[index];
        QUORUM_ASSIGN(const auto mask, work.images.mask(static_cast<int>(index)));
        const ProjectedMesh projected = project_mesh(work.mesh, view);
        const auto nearness = nearness_buffer(work.mesh, projected, view.width, view.height);
        rate_triangles(
            work.mesh, pieces,
            {static_cast<std::uint32_t>(index), view.camera.center(), photograph, *mask, projected, nearness},
            candidates);
        return {};
      });
}

FacingPixels facing_pixels(const Texturing& work, const std::vector<SurfacePiece>& pieces) {
  return [&, projectors = view_projectors(work.scene)](std::uint32_t triangle, std::int32_t index) -> double {
    const View& view = work.scene.views[static_cast<std::size_t>(index)];
    if (cosine_to(pieces[triangle], view.camera.center()) < kLeastFacing) return -1;
    std::array<ProjectedVertex, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const Vertex& vertex = work.mesh.vertices[work.mesh.triangles[triangle][i]];
      corners[i] = snap(projectors[static_cast<std::size_t>(index)](vertex.position.cast<double>()));
      if (!is_in_frame(corners[i], view.width, view.height)) return -1;
    }
    return TrianglePixels(corners[0], corners[1], corners[2]).area();
  };
}

/// Shifts of levels for all patch vertices; none if colors are to stay.
Expected<std::vector<LevelShift>> find_shifts(const Texturing& work, const std::vector<std::int32_t>& views,
                                              const PatchVertices& patch_vertices, const Candidates& candidates) {
  std::vector<LevelShift> colors(patch_vertices.views.size());
  if (!work.options.level) return colors;
  const auto places = seams_by_view(patch_vertices, work.scene.views.size());
  QUORUM_TRY(for_each_photograph(
      work, "comparing seams", [&](std::size_t view) { return !places[view].empty(); },
      [&](std::size_t view, const ColorImage& photograph) -> Expected<void> {
        sample_seams(work.mesh, patch_vertices, places[view], work.scene.views[view], photograph, colors);
        return {};
      }));
  return level_seams(work.mesh, views, patch_vertices, colors,
                     shifts_to_mean(work.mesh, views, patch_vertices, candidates));
}

/// Edge of a pixel on the surface, scene units, over all triangles that are seen.
double mean_pixel_size(const std::vector<SurfacePiece>& pieces, const OwnPlaces& places,
                       const std::vector<std::int32_t>& views) {
  double surface = 0;
  double pixels = 0;
  for (std::uint32_t t = 0; t < views.size(); ++t) {
    if (views[t] == kUnseen) continue;
    surface += double{pieces[t].area};
    pixels += places.pixels(t).area();
  }
  return pixels > 0 ? std::sqrt(surface / pixels) : 0;
}

Expected<std::vector<ColorImage>> paint_all(const Texturing& work, const PaintPlan& plan) {
  QUORUM_TRY(work.watch.require(plan.charts.pixels() * PagePainter::kPixelBytes, "the pages of the texture"));
  PagePainter painter(plan);
  std::set<std::size_t> used;
  for (const Chart& chart : plan.charts.charts) used.insert(static_cast<std::size_t>(chart.view));
  QUORUM_TRY(for_each_photograph(
      work, "painting pages", [&](std::size_t view) { return used.contains(view); },
      [&](std::size_t view, const ColorImage& photograph) -> Expected<void> {
        painter.paint(static_cast<std::int32_t>(view), photograph);
        return {};
      }));
  return painter.take();
}

TextureCounts count(const std::vector<std::int32_t>& views, const Charts& charts) {
  TextureCounts counts;
  counts.triangles = views.size();
  counts.unseen = static_cast<std::size_t>(std::ranges::count(views, kUnseen));
  counts.patches = charts.charts.size();
  std::set<std::int32_t> used;
  for (const Chart& chart : charts.charts) used.insert(chart.view);
  counts.views = used.size();
  return counts;
}

/// Bytes of what is held per triangle and vertex, and of the largest photograph with all that is made of it.
std::uint64_t working_bytes(const Mesh& mesh, const Scene& scene) {
  std::uint64_t largest = 0;
  for (const View& view : scene.views)
    largest = std::max(largest, static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height));
  constexpr std::uint64_t kPerTriangle = Candidates::kMost * (sizeof(Candidate) + 4) + 64;
  constexpr std::uint64_t kPerVertex = 160;
  constexpr std::uint64_t kPerPixel = 24;
  return mesh.triangles.size() * kPerTriangle + mesh.vertices.size() * kPerVertex + largest * kPerPixel;
}

/// Fails (kInput) if the mesh is of something else.
Expected<void> check_colors(const Mesh& mesh, const Candidates& candidates) {
  constexpr int kMost = 28;  // levels
  const int difference = color_difference(mesh, candidates);
  if (difference <= kMost) return {};
  return failure(
      ErrorKind::kInput,
      fmt::format("the photographs show other colors than the mesh has, by {} levels at half of its triangles: "
                  "is it one of this scene, in its coordinates? Without its colors it is taken as it is",
                  difference));
}

Expected<Textured> texture(const Texturing& work) {
  QUORUM_TRY(work.watch.require(working_bytes(work.mesh, work.scene), "texturing the mesh"));
  const MeshLinks links = link_mesh(work.mesh);
  Candidates candidates(work.mesh.triangles.size());
  const std::vector<SurfacePiece> pieces = surface_pieces(work.mesh, links, smoothing_steps(work.mesh, work.scene));
  QUORUM_TRY(rate_all(work, pieces, candidates));
  QUORUM_TRY(check_colors(work.mesh, candidates));
  mark_disagreement(candidates);
  const std::vector<std::int32_t> views = choose_views(links, candidates, facing_pixels(work, pieces));
  if (std::ranges::all_of(views, [](std::int32_t view) { return view == kUnseen; }))
    return failure(
        ErrorKind::kInput,
        "no photograph shows any triangle from its front; is the mesh one of this scene, in its coordinates?");
  const OwnPlaces places(work.mesh, work.scene, views);
  QUORUM_ASSIGN(const Charts charts, make_charts(links, places, views, work.options.page_size));
  const PatchVertices patch_vertices = make_patch_vertices(links, views);
  QUORUM_ASSIGN(const auto shifts, find_shifts(work, views, patch_vertices, candidates));
  const double band = work.options.band_pixels * mean_pixel_size(pieces, places, views);
  const std::vector<BlendPart> parts = blend_band(work.mesh, links, views, patch_vertices, shifts, candidates, band);
  candidates = Candidates(0);

  QUORUM_ASSIGN(auto pages,
                paint_all(work, {work.scene, work.mesh, places, views, charts, patch_vertices, shifts, parts}));
  return Textured{assemble(work.mesh, views, places, charts, std::move(pages)), count(views, charts)};
}

}  // namespace

const std::vector<Option<TextureOptions>>& texture_option_table() {
  using Make = OptionMaker<TextureOptions>;
  // clang-format off
  static const std::vector<Option<TextureOptions>> kTable = {
    Make::number("size", QUORUM_MEMBER(page_size), {256, 8192}, "Largest side of a page, pixels; what does not fit goes to further pages"),
    Make::number("band", QUORUM_MEMBER(band_pixels), {0, 64}, "Pixels on each side of a seam over which one photograph passes into the other"),
    Make::toggle("level", QUORUM_MEMBER(level), "Leave the colors of photographs as they are"),
  };
  // clang-format on
  return kTable;
}

Expected<Textured> texture_mesh(const Mesh& mesh, const Scene& scene, ImageStore& images, const TextureOptions& options,
                                const TextureWatch& watch) {
  if (mesh.triangles.empty())
    return failure(ErrorKind::kInput, "the mesh has no triangles to put a texture on; give a surface, not a cloud");
  const Mesh whole = make_manifold(mesh);
  return texture({whole, scene, images, options, watch});
}

}  // namespace quorum
