// The patches as pieces of photographs, and their places on pages.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/error.h"
#include "engine/texture/choose_views.h"
#include "engine/texture/project_mesh.h"

namespace quorum {

/// Triangles side by side that are taken from one photograph. A pixel of the photograph is one of the page.
struct Chart {
  static constexpr int kMargin = 3;  ///< pixels around the triangles

  std::int32_t view = 0;
  std::uint32_t first = 0;  ///< its triangles: those of Charts::triangles from here
  std::uint32_t end = 0;    ///< up to here
  int x = 0;                ///< upper left pixel in the photograph, margin included; may lie outside
  int y = 0;
  int width = 0;  ///< pixels, margin included
  int height = 0;
  int page = 0;
  int page_x = 0;  ///< upper left pixel on the page
  int page_y = 0;
};

struct PageSize {
  int width = 0;
  int height = 0;
};

struct Charts {
  std::vector<Chart> charts = {};             ///< ascending by page, then by lowest triangle
  std::vector<std::uint32_t> triangles = {};  ///< of all charts, ascending in each
  std::vector<PageSize> pages = {};

  [[nodiscard]] std::span<const std::uint32_t> of(const Chart& chart) const {
    return std::span(triangles).subspan(chart.first, chart.end - chart.first);
  }
  [[nodiscard]] std::uint64_t pixels() const;  ///< of all pages
};

/// Corners of triangles in the photographs that they are taken from.
class OwnPlaces {
 public:
  OwnPlaces(const Mesh& mesh, const Scene& scene, const std::vector<std::int32_t>& views);
  [[nodiscard]] Projector::Place place(std::uint32_t triangle, int corner) const;
  [[nodiscard]] ProjectedVertex corner(std::uint32_t triangle, int corner) const {
    return snap(place(triangle, corner));
  }
  [[nodiscard]] TrianglePixels pixels(std::uint32_t triangle) const {
    return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
  }

 private:
  const Mesh& mesh_;
  const std::vector<std::int32_t>& views_;
  std::vector<Projector> projectors_;
};

/// Makes the charts of all triangles that have a view, and packs them into pages of at most page_size × page_size
/// pixels by stb_rect_pack's skylines (bottom left); a page is cut below its lowest chart. A patch that is larger than
/// a page is cut. Fails (kInput) if a single triangle is.
Expected<Charts> make_charts(const MeshLinks& links, const OwnPlaces& places, const std::vector<std::int32_t>& views,
                             int page_size);

}  // namespace quorum
