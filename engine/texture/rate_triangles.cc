#include "engine/texture/rate_triangles.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "engine/texture/sample_color.h"

namespace quorum {
namespace {

constexpr double kLevelsOfFlat = 24;  // gradient that flat places are given
constexpr double kMostLevels = 48;
constexpr double kShareAtOutlines = 0.125;

/// Mean of the 17 values around each, fewer at the ends.
template <typename Value, typename Mean>
void mean_along(int count, const Value& value, const Mean& mean) {
  constexpr int kReach = 8;
  std::uint32_t sum = 0;
  for (int i = 0; i < std::min(kReach, count); ++i) sum += value(i);
  for (int i = 0; i < count; ++i) {
    if (i + kReach < count) sum += value(i + kReach);
    if (i - kReach > 0) sum -= value(i - kReach - 1);
    const int used = std::min(i + kReach, count - 1) - std::max(i - kReach, 0) + 1;
    mean(i, static_cast<std::uint8_t>(sum / static_cast<std::uint32_t>(used)));
  }
}

/// Differences of brightness along x and y, added, 0..255.
Grid<std::uint8_t> gradient_of(const ColorImage& image) {
  const auto brightness = [&](int x, int y) {
    const Rgba pixel = image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
    return static_cast<int>(red_of(pixel) + 2 * green_of(pixel) + blue_of(pixel)) / 4;
  };
  Grid<std::uint8_t> gradient(image.width, image.height);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const int along_x = std::abs(brightness(x + 1, y) - brightness(x - 1, y));
      const int along_y = std::abs(brightness(x, y + 1) - brightness(x, y - 1));
      gradient.at(x, y) = static_cast<std::uint8_t>((along_x + along_y) / 2);
    }
  });
  return gradient;
}

/// How sharp the photograph is around each pixel: the mean gradient. A triangle of a pixel would not tell.
Grid<std::uint8_t> sharpness_of(const ColorImage& image) {
  Grid<std::uint8_t> sharpness = gradient_of(image);
  Grid<std::uint8_t> along_x(image.width, image.height);
  tbb::parallel_for(0, image.height, [&](int y) {
    mean_along(
        image.width, [&](int x) { return sharpness.at(x, y); },
        [&](int x, std::uint8_t mean) { along_x.at(x, y) = mean; });
  });
  tbb::parallel_for(0, image.width, [&](int x) {
    mean_along(
        image.height, [&](int y) { return along_x.at(x, y); },
        [&](int y, std::uint8_t mean) { sharpness.at(x, y) = mean; });
  });
  return sharpness;
}

/// A triangle in a view.
class Rating {
 public:
  Rating(const RatedView& view, const Grid<std::uint8_t>& gradient, const std::array<std::uint32_t, 3>& triangle,
         const SurfacePiece& piece)
      : view_(view),
        gradient_(gradient),
        piece_(piece),
        corners_{&view.projected.vertices[triangle[0]], &view.projected.vertices[triangle[1]],
                 &view.projected.vertices[triangle[2]]},
        pixels_(*corners_[0], *corners_[1], *corners_[2]) {}

  /// Empty if the view does not show it.
  std::optional<Candidate> candidate() {
    double area = facing_area();
    if (pixels_.signed_area() == 0 || area == 0 || !is_within()) return std::nullopt;
    tolerance_ = tolerance();
    for (const ProjectedVertex* corner : corners_)
      if (!is_seen(corner->x, corner->y, corner->nearness)) return std::nullopt;
    const std::array<std::int32_t, 2> middle = {(corners_[0]->x + corners_[1]->x + corners_[2]->x) / 3,
                                                (corners_[0]->y + corners_[1]->y + corners_[2]->y) / 3};
    if (!is_seen(middle[0], middle[1], nearness({1 / 3.0, 1 / 3.0, 1 / 3.0}))) return std::nullopt;
    add_pixels();
    if (hidden_) return std::nullopt;
    if (count_ == 0) add_point(middle[0], middle[1]);
    Candidate candidate;
    candidate.view = view_.index;
    if (is_at_outline(middle[0], middle[1])) area *= kShareAtOutlines;
    const double gradient = static_cast<double>(gradients_) / static_cast<double>(count_);
    candidate.quality = static_cast<float>(area * (kLevelsOfFlat + std::min(gradient, kMostLevels)));
    for (int channel = 0; channel < 3; ++channel)
      candidate.color[channel] = static_cast<std::uint8_t>(colors_[channel] / count_);
    return candidate;
  }

 private:
  /// Pixels that the triangle would cover if it lay as the surface around it, times the cosine; 0 if that is turned
  /// away.
  [[nodiscard]] double facing_area() const {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double to_camera = view_.center[axis] - double{piece_.center[axis]};
      square += to_camera * to_camera;
    }
    const double cosine = cosine_to(piece_, view_.center);
    const double pixels = piece_.area / (square * view_.projected.footprint * view_.projected.footprint);
    return cosine >= kLeastFacing ? pixels * cosine * cosine : 0;
  }

  /// Whether all corners lie a pixel or more inside the frame.
  [[nodiscard]] bool is_within() const {
    return std::ranges::all_of(corners_, [&](const ProjectedVertex* corner) {
      return is_in_frame(*corner, view_.image.width, view_.image.height);
    });
  }

  [[nodiscard]] double nearness(const std::array<double, 3>& shares) const {
    return shares[0] * corners_[0]->nearness + shares[1] * corners_[1]->nearness + shares[2] * corners_[2]->nearness;
  }

  /// How much nearer than the triangle the buffer may be: it holds the nearest of pixels up to 1.5 away.
  [[nodiscard]] double tolerance() const {
    double slope = 0;
    for (const bool along_x : {true, false}) {
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        const ProjectedVertex& from = *corners_[(i + 1) % 3];
        const ProjectedVertex& to = *corners_[(i + 2) % 3];
        sum += static_cast<double>(along_x ? from.y - to.y : to.x - from.x) * corners_[i]->nearness;
      }
      slope += std::abs(sum * kSubpixels / static_cast<double>(pixels_.signed_area()));
    }
    constexpr double kFootprints = 3;
    return corners_[0]->nearness * kFootprints * view_.projected.footprint + 1.5 * slope + 2;
  }

  [[nodiscard]] bool is_seen(std::int32_t x, std::int32_t y, double nearness) const {
    const int column = (x + kSubpixels / 2) / kSubpixels;
    const int row = (y + kSubpixels / 2) / kSubpixels;
    return view_.nearness.largest.at(column, row) <= nearness + tolerance_ &&
           (view_.mask.empty() || view_.mask.at(column, row) != 0);
  }

  /// Whether something far behind, or nothing, is seen within three pixels.
  [[nodiscard]] bool is_at_outline(std::int32_t x, std::int32_t y) const {
    const std::uint32_t farthest =
        view_.nearness.smallest.at((x + kSubpixels / 2) / kSubpixels, (y + kSubpixels / 2) / kSubpixels);
    return farthest + 4 * tolerance_ < nearness({1 / 3.0, 1 / 3.0, 1 / 3.0});
  }

  void add_pixels() {
    pixels_.for_each(view_.image.width, view_.image.height, [&](int x, int y, const std::array<double, 3>& shares) {
      if (hidden_ || !is_seen(x * kSubpixels, y * kSubpixels, nearness(shares))) {
        hidden_ = true;
        return;
      }
      const std::array<std::int32_t, 3> color = levels_of(view_.image.at(x, y));
      for (int channel = 0; channel < 3; ++channel) colors_[channel] += color[channel];
      gradients_ += gradient_.at(x, y);
      ++count_;
    });
  }

  void add_point(std::int32_t x, std::int32_t y) {
    const std::array<std::int32_t, 3> color = sample_color(view_.image, x, y);
    for (int channel = 0; channel < 3; ++channel) colors_[channel] += color[channel] / kSubpixels;
    gradients_ += gradient_.at((x + kSubpixels / 2) / kSubpixels, (y + kSubpixels / 2) / kSubpixels);
    ++count_;
  }

  const RatedView& view_;
  const Grid<std::uint8_t>& gradient_;
  const SurfacePiece& piece_;
  std::array<const ProjectedVertex*, 3> corners_;
  TrianglePixels pixels_;
  double tolerance_ = 0;
  bool hidden_ = false;
  std::array<std::int64_t, 3> colors_ = {};
  std::int64_t gradients_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace

void rate_triangles(const Mesh& mesh, const std::vector<SurfacePiece>& pieces, const RatedView& view,
                    Candidates& candidates) {
  const Grid<std::uint8_t> gradient = sharpness_of(view.image);
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
    if (const auto candidate = Rating(view, gradient, mesh.triangles[t], pieces[t]).candidate())
      candidates.add(t, *candidate);
  });
}

}  // namespace quorum
