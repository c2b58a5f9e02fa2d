#include "engine/texture/paint_pages.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "engine/texture/sample_color.h"

namespace quorum {
namespace {

constexpr int kWhole = 256;  // sum of the weights of a pixel

using Barycentric = std::array<double, 3>;

/// Those of the place in the triangle that is near.
Barycentric clamped(const Barycentric& shares) {
  Barycentric inside{};
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += inside[i] = std::clamp(shares[i], 0.0, 1.0);
  for (double& share : inside) share /= sum;
  return inside;
}

int weight_of(const BlendPart& part, const Barycentric& shares) {
  return static_cast<int>((shares[0] * part.shares[0] + shares[1] * part.shares[1] + shares[2] * part.shares[2]) *
                          kWhole);
}

/// color: 1/256 levels.
void add_color(std::array<std::uint16_t, 3>& sums, const std::array<std::int32_t, 3>& color, const Barycentric& shares,
               const std::array<const LevelShift*, 3>& shifts, int weight) {
  for (int channel = 0; channel < 3; ++channel) {
    const double shift =
        shares[0] * (*shifts[0])[channel] + shares[1] * (*shifts[1])[channel] + shares[2] * (*shifts[2])[channel];
    const double level = std::clamp(color[channel] / 256.0 + shift, 0.0, 255.0);
    sums[channel] = static_cast<std::uint16_t>(sums[channel] + static_cast<int>(level + 0.5) * weight);
  }
}

/// A surface point of a triangle at shares of its picture.
Eigen::Vector3d point_at(const Mesh& mesh, const OwnPlaces& places, std::uint32_t triangle, const Barycentric& shares) {
  constexpr double kFarOutside = -4;  // a small triangle does not tell how the surface goes on
  const Barycentric used = std::ranges::min(shares) < kFarOutside ? clamped(shares) : shares;
  Barycentric nearness{};
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += nearness[i] = used[i] / places.place(triangle, i).depth;
  double point[3] = {};
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis)
      point[axis] += nearness[i] / sum * double{mesh.vertices[mesh.triangles[triangle][i]].position[axis]};
  return {point[0], point[1], point[2]};
}

}  // namespace

PagePainter::PagePainter(const PaintPlan& plan)
    : plan_(plan), chart_of_(plan.mesh.triangles.size()), has_margin_(plan.mesh.triangles.size()) {
  for (const PageSize& page : plan_.charts.pages) {
    owners_.emplace_back(page.width, page.height, kNoTriangle);
    sums_.emplace_back(owners_.back().values.size());
  }
  for (std::uint32_t chart = 0; chart < plan_.charts.charts.size(); ++chart)
    for (const std::uint32_t t : plan_.charts.of(plan_.charts.charts[chart])) chart_of_[t] = chart;
  for (std::size_t i = 0; i < plan_.parts.size(); ++i) {
    const auto view = static_cast<std::size_t>(plan_.parts[i].view);
    if (parts_of_view_.size() <= view) parts_of_view_.resize(view + 1);
    parts_of_view_[view].push_back(i);
  }
  tbb::parallel_for(std::size_t{0}, plan_.charts.charts.size(), [&](std::size_t i) {
    find_owners(plan_.charts.charts[i]);
    grow_owners(plan_.charts.charts[i]);
  });
}

/// Each pixel belongs to the first triangle that covers it.
void PagePainter::find_owners(const Chart& chart) {
  Grid<std::uint32_t>& owners = owners_[static_cast<std::size_t>(chart.page)];
  const View& view = plan_.scene.views[static_cast<std::size_t>(chart.view)];
  const auto owner_at = [&](int x, int y) -> std::uint32_t& {
    return owners.at(x - chart.x + chart.page_x, y - chart.y + chart.page_y);
  };
  bool is_empty = true;
  for (const std::uint32_t t : plan_.charts.of(chart))
    plan_.places.pixels(t).for_each(view.width, view.height, [&](int x, int y, const Barycentric&) {
      if (owner_at(x, y) == kNoTriangle) owner_at(x, y) = t;
      is_empty = false;
    });
  if (!is_empty) return;
  // It covers no pixel's center, and gets a pixel to grow from.
  const std::uint32_t first = plan_.charts.of(chart)[0];
  const ProjectedVertex corner = plan_.places.corner(first, 0);
  owner_at((corner.x + kSubpixels / 2) >> 8, (corner.y + kSubpixels / 2) >> 8) = first;
  has_margin_[first] = 1;
}

/// Pixels around a chart belong to the triangle of a pixel beside them: what is drawn smoothly reads them, too.
void PagePainter::grow_owners(const Chart& chart) {
  const View& view = plan_.scene.views[static_cast<std::size_t>(chart.view)];
  Grid<std::uint32_t>& owners = owners_[static_cast<std::size_t>(chart.page)];
  const auto owner_at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < chart.width && y < chart.height;
    return inside ? owners.at(chart.page_x + x, chart.page_y + y) : kNoTriangle;
  };
  std::vector<std::pair<std::uint32_t*, std::uint32_t>> grown;
  for (int step = 0; step < Chart::kMargin; ++step) {
    grown.clear();
    for (int y = 0; y < chart.height; ++y)
      for (int x = 0; x < chart.width; ++x) {
        const bool in_photo =
            x + chart.x >= 0 && y + chart.y >= 0 && x + chart.x < view.width && y + chart.y < view.height;
        if (!in_photo || owner_at(x, y) != kNoTriangle) continue;
        for (const auto& [dx, dy] : {std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1)})
          if (const std::uint32_t owner = owner_at(x + dx, y + dy); owner != kNoTriangle) {
            grown.emplace_back(&owners.at(chart.page_x + x, chart.page_y + y), owner);
            break;
          }
      }
    for (const auto& [pixel, owner] : grown) {
      *pixel = owner;
      has_margin_[owner] = 1;
    }
  }
}

/// Calls paint(sums, x, y, shares) for each pixel that belongs to a triangle; x and y in its photograph.
template <typename Paint>
void PagePainter::for_each_pixel(std::uint32_t triangle, const Paint& paint) {
  const Chart& chart = plan_.charts.charts[chart_of_[triangle]];
  const auto page = static_cast<std::size_t>(chart.page);
  const TrianglePixels pixels = plan_.places.pixels(triangle);
  const int grow = has_margin_[triangle] != 0 ? Chart::kMargin + 1 : 0;
  const TrianglePixels::Box box = pixels.box(chart.x + chart.width, chart.y + chart.height, grow);
  for (int y = std::max(box.y0, chart.y); y <= box.y1; ++y)
    for (int x = std::max(box.x0, chart.x); x <= box.x1; ++x) {
      const int on_page_x = x - chart.x + chart.page_x;
      const int on_page_y = y - chart.y + chart.page_y;
      if (owners_[page].at(on_page_x, on_page_y) != triangle) continue;
      const std::size_t place = static_cast<std::size_t>(on_page_y) * static_cast<std::size_t>(owners_[page].width) +
                                static_cast<std::size_t>(on_page_x);
      paint(sums_[page][place], x, y, pixels.shares(x, y));
    }
}

std::span<const BlendPart> PagePainter::parts_of(std::uint32_t triangle) const {
  const auto range = std::ranges::equal_range(plan_.parts, triangle, {}, &BlendPart::triangle);
  return {range.begin(), range.end()};
}

void PagePainter::paint_own(std::uint32_t triangle, const ColorImage& photograph) {
  const std::span<const BlendPart> parts = parts_of(triangle);
  std::array<const LevelShift*, 3> shifts{};
  for (int i = 0; i < 3; ++i)
    shifts[i] = &plan_.shifts[plan_.patch_vertices.find(plan_.mesh.triangles[triangle][i], plan_.views[triangle])];
  for_each_pixel(triangle, [&](auto& sums, int x, int y, const Barycentric& shares) {
    const Barycentric inside = clamped(shares);
    int weight = kWhole;
    for (const BlendPart& part : parts) weight -= weight_of(part, inside);
    std::array<std::int32_t, 3> color = levels_of(photograph.at(x, y));
    for (std::int32_t& channel : color) channel *= kSubpixels;
    add_color(sums, color, inside, shifts, weight);
  });
}

void PagePainter::paint_part(const BlendPart& part, const Projector& project, const ColorImage& photograph) {
  for_each_pixel(part.triangle, [&](auto& sums, int, int, const Barycentric& shares) {
    const Barycentric inside = clamped(shares);
    const ProjectedVertex place = snap(project(point_at(plan_.mesh, plan_.places, part.triangle, shares)));
    add_color(sums, sample_color(photograph, place.x, place.y), inside,
              {&part.shifts[0], &part.shifts[1], &part.shifts[2]}, weight_of(part, inside));
  });
}

void PagePainter::paint(std::int32_t view, const ColorImage& photograph) {
  for (const Chart& chart : plan_.charts.charts) {
    if (chart.view != view) continue;
    const std::span<const std::uint32_t> triangles = plan_.charts.of(chart);
    tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t i) { paint_own(triangles[i], photograph); });
  }
  if (static_cast<std::size_t>(view) >= parts_of_view_.size()) return;
  const std::vector<std::size_t>& parts = parts_of_view_[static_cast<std::size_t>(view)];
  const Projector project(plan_.scene.views[static_cast<std::size_t>(view)].camera);
  tbb::parallel_for(std::size_t{0}, parts.size(),
                    [&](std::size_t i) { paint_part(plan_.parts[parts[i]], project, photograph); });
}

std::vector<ColorImage> PagePainter::take() {
  std::vector<ColorImage> pages;
  for (std::size_t page = 0; page < owners_.size(); ++page) {
    ColorImage image = std::move(owners_[page]);  // pixels take the places of their owners
    const Sums sums = std::move(sums_[page]);
    std::array<std::uint64_t, 3> all{};
    std::uint64_t count = 0;
    const auto level = [](std::uint16_t sum) { return static_cast<std::uint32_t>((sum + kWhole / 2) / kWhole); };
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (image.values[i] == kNoTriangle) continue;
      for (int channel = 0; channel < 3; ++channel) all[channel] += level(sums[i][channel]);
      ++count;
    }
    const auto mean = [&](int channel) { return count > 0 ? static_cast<std::uint32_t>(all[channel] / count) : 0; };
    const Rgba around = make_rgb(mean(0), mean(1), mean(2));
    for (std::size_t i = 0; i < sums.size(); ++i)
      image.values[i] =
          image.values[i] == kNoTriangle ? around : make_rgb(level(sums[i][0]), level(sums[i][1]), level(sums[i][2]));
    pages.push_back(std::move(image));
  }
  return pages;
}

}  // namespace quorum
