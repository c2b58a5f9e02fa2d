#include "engine/texture/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>
#include <utility>

#include "engine/mesh/disjoint_sets.h"

namespace {

/// In place of the C library's qsort, which may give equal ones in any order.
template <typename Compare>
void sort_in_order(void* rectangles, int count, std::size_t size, Compare compare);

}  // namespace

#define STBRP_STATIC
#define STBRP_SORT sort_in_order
#define STB_RECT_PACK_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_rect_pack.h>
#pragma GCC diagnostic pop

namespace {

template <typename Compare>
void sort_in_order(void* rectangles, int count, std::size_t /*size*/, Compare compare) {
  auto* first = static_cast<stbrp_rect*>(rectangles);
  std::stable_sort(first, first + count, [&](const stbrp_rect& a, const stbrp_rect& b) { return compare(&a, &b) < 0; });
}

}  // namespace

namespace quorum {
namespace {

/// Per triangle the lowest one of its chart. Charts of photographs that are larger than a page are cut along its tiles.
std::vector<std::uint32_t> find_patches(const MeshLinks& links, const OwnPlaces& places,
                                        const std::vector<std::int32_t>& views, int page_size) {
  const auto tile_of = [&](std::uint32_t t) {
    const int tile = page_size / 2 * kSubpixels;
    const ProjectedVertex corner = places.corner(t, 0);
    return std::pair(corner.x / tile, corner.y / tile);
  };
  DisjointSets sets(views.size());
  for (std::uint32_t t = 0; t < views.size(); ++t)
    for (const std::uint32_t neighbor : links.neighbors[t])
      if (neighbor != kNoTriangle && neighbor < t && views[t] != kUnseen && views[neighbor] == views[t] &&
          tile_of(neighbor) == tile_of(t))
        sets.join(t, neighbor);
  std::vector<std::uint32_t> lowest(views.size());
  for (std::uint32_t t = 0; t < views.size(); ++t) lowest[t] = sets.find(t);
  return lowest;
}

void place_in_photograph(const OwnPlaces& places, std::span<const std::uint32_t> triangles, Chart& chart) {
  constexpr int kFar = 1 << 30;
  TrianglePixels::Box all{kFar, kFar, -kFar, -kFar};
  for (const std::uint32_t t : triangles)
    for (int i = 0; i < 3; ++i) {
      const ProjectedVertex corner = places.corner(t, i);
      all.x0 = std::min(all.x0, corner.x >> 8);
      all.y0 = std::min(all.y0, corner.y >> 8);
      all.x1 = std::max(all.x1, (corner.x >> 8) + 1);
      all.y1 = std::max(all.y1, (corner.y >> 8) + 1);
    }
  chart.x = all.x0 - Chart::kMargin;
  chart.y = all.y0 - Chart::kMargin;
  chart.width = all.x1 - all.x0 + 1 + 2 * Chart::kMargin;
  chart.height = all.y1 - all.y0 + 1 + 2 * Chart::kMargin;
}

/// A power of two of which a page would hold all, if nothing was lost between charts; at most page_size.
int wanted_width(const std::vector<stbrp_rect>& left, int page_size) {
  std::int64_t area = 0;
  int width = 64;
  for (const stbrp_rect& rectangle : left) {
    area += std::int64_t{rectangle.w} * rectangle.h;
    while (width < rectangle.w) width *= 2;
  }
  while (std::int64_t{width} * width < area) width *= 2;
  return std::min(width, page_size);
}

/// Places what fits on one more page; the rest stays left.
void fill_page(std::vector<stbrp_rect>& left, int page_size, Charts& charts) {
  const int width = wanted_width(left, page_size);
  std::vector<stbrp_node> nodes(static_cast<std::size_t>(width));
  stbrp_context context;
  stbrp_init_target(&context, width, page_size, nodes.data(), width);
  stbrp_pack_rects(&context, left.data(), static_cast<int>(left.size()));
  int height = 1;
  for (const stbrp_rect& rectangle : left) {
    if (rectangle.was_packed == 0) continue;
    Chart& chart = charts.charts[static_cast<std::size_t>(rectangle.id)];
    chart.page = static_cast<int>(charts.pages.size());
    chart.page_x = rectangle.x;
    chart.page_y = rectangle.y;
    height = std::max(height, rectangle.y + rectangle.h);
  }
  charts.pages.push_back({width, height});
  std::erase_if(left, [](const stbrp_rect& rectangle) { return rectangle.was_packed != 0; });
}

}  // namespace

std::uint64_t Charts::pixels() const {
  return std::accumulate(pages.begin(), pages.end(), std::uint64_t{0}, [](std::uint64_t sum, const PageSize& page) {
    return sum + static_cast<std::uint64_t>(page.width) * static_cast<std::uint64_t>(page.height);
  });
}

OwnPlaces::OwnPlaces(const Mesh& mesh, const Scene& scene, const std::vector<std::int32_t>& views)
    : mesh_(mesh), views_(views), projectors_(view_projectors(scene)) {}

Projector::Place OwnPlaces::place(std::uint32_t triangle, int corner) const {
  return projectors_[static_cast<std::size_t>(views_[triangle])](
      mesh_.vertices[mesh_.triangles[triangle][corner]].position.cast<double>());
}

Expected<Charts> make_charts(const MeshLinks& links, const OwnPlaces& places, const std::vector<std::int32_t>& views,
                             int page_size) {
  const std::vector<std::uint32_t> lowest = find_patches(links, places, views, page_size);
  Charts made;
  for (std::uint32_t t = 0; t < views.size(); ++t)
    if (views[t] != kUnseen) made.triangles.push_back(t);
  std::ranges::stable_sort(made.triangles, {}, [&](std::uint32_t t) { return lowest[t]; });
  for (std::uint32_t i = 0; i < made.triangles.size(); ++i) {
    if (i == 0 || lowest[made.triangles[i]] != lowest[made.triangles[i - 1]]) {
      Chart chart;
      chart.view = views[made.triangles[i]];
      chart.first = i;
      made.charts.push_back(chart);
    }
    made.charts.back().end = i + 1;
  }
  std::vector<stbrp_rect> left;
  for (Chart& chart : made.charts) {
    place_in_photograph(places, made.of(chart), chart);
    if (chart.width > page_size || chart.height > page_size)
      return failure(ErrorKind::kInput,
                     fmt::format("a triangle covers {} x {} pixels of a photograph, more than a page "
                                 "of {}; give larger pages or a finer mesh",
                                 chart.width, chart.height, page_size));
    left.push_back({static_cast<int>(left.size()), chart.width, chart.height, 0, 0, 0});
  }
  while (!left.empty()) fill_page(left, page_size, made);
  std::ranges::stable_sort(made.charts, {}, &Chart::page);
  return made;
}

}  // namespace quorum
