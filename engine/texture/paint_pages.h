// Fills pages with what the photographs show, one photograph at a time.
#pragma once

#include <vector>

#include "engine/texture/blend_band.h"
#include "engine/texture/charts.h"

namespace quorum {

/// What pages are painted from. All of it outlives the painter.
struct PaintPlan {
  const Scene& scene;
  const Mesh& mesh;
  const OwnPlaces& places;
  const std::vector<std::int32_t>& views;  ///< per triangle
  const Charts& charts;
  const PatchVertices& patch_vertices;
  const std::vector<LevelShift>& shifts;  ///< per patch vertex
  const std::vector<BlendPart>& parts;    ///< ascending by triangle
};

class PagePainter {
 public:
  static constexpr std::uint64_t kPixelBytes = 10;  ///< held per pixel of a page

  explicit PagePainter(const PaintPlan& plan);

  /// Adds all that is taken from this view's photograph. Each view once.
  void paint(std::int32_t view, const ColorImage& photograph);
  /// The pages, when all views are painted. Pixels of no chart have the mean color.
  std::vector<ColorImage> take();

 private:
  using Sums = std::vector<std::array<std::uint16_t, 3>>;  ///< of levels × 1/256; weights sum to 256

  void find_owners(const Chart& chart);
  void grow_owners(const Chart& chart);
  template <typename Paint>
  void for_each_pixel(std::uint32_t triangle, const Paint& paint);
  void paint_own(std::uint32_t triangle, const ColorImage& photograph);
  void paint_part(const BlendPart& part, const Projector& project, const ColorImage& photograph);
  [[nodiscard]] std::span<const BlendPart> parts_of(std::uint32_t triangle) const;

  PaintPlan plan_;
  std::vector<std::uint32_t> chart_of_;      ///< per triangle
  std::vector<std::uint8_t> has_margin_;     ///< per triangle: pixels around it are its own, too
  std::vector<Grid<std::uint32_t>> owners_;  ///< per page and pixel: a triangle or kNoTriangle
  std::vector<Sums> sums_;                   ///< likewise
  std::vector<std::vector<std::size_t>> parts_of_view_;
};

}  // namespace quorum
