#include "engine/volume/confirm_depths.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

#include "engine/core/check.h"
#include "engine/core/exact.h"
#include "engine/depth/plane_warp.h"
#include "engine/volume/cell.h"
#include "engine/volume/range_surface.h"

namespace quorum {
namespace {

/// A depth of a view in another: position in pixels and depth, which say nothing unless z > 0.
struct SeenPoint {
  float u;
  float v;
  float z;
};

/// Pixel (x, y) at depth d; z is 0 if it lies at or behind the other camera. Twin: see_from in
/// shaders/confirm_depths.comp.
[[gnu::always_inline]] inline SeenPoint see_from(const PlaneWarp& warp, float x, float y, float d) {
  const float rx = warp.rotation[0] * x + (warp.rotation[1] * y + warp.rotation[2]);
  const float ry = warp.rotation[3] * x + (warp.rotation[4] * y + warp.rotation[5]);
  const float rz = warp.rotation[6] * x + (warp.rotation[7] * y + warp.rotation[8]);
  const float z = rz * d + warp.offset[2];
  const bool before = z > kMinDepthRatio * d;
  const float inverse_z = reciprocal(before ? z : 1.0F);
  return {(rx * d + warp.offset[0]) * inverse_z, (ry * d + warp.offset[1]) * inverse_z, before ? z : 0.0F};
}

/// Whether a point lies between four pixels of an image.
[[gnu::always_inline]] inline bool is_in_a_cell(const SeenPoint& point, int width, int height) {
  return (point.z > 0.0F) & (point.u >= 0.0F) & (point.v >= 0.0F) & (point.u < static_cast<float>(width - 1)) &
         (point.v < static_cast<float>(height - 1));
}

/// True if the view looks through the other's depth at pixel (x, y): some of the four pixels around its projection have
/// a depth, and all that have one lie behind it. Twin: looks_through in shaders/confirm_depths.comp.
bool looks_through(const Grid<float>& depth, const ConfirmDepthsParams& params, int x, int y, float other_depth) {
  const SeenPoint point = see_from(params.back, static_cast<float>(x), static_cast<float>(y), other_depth);
  if (!is_in_a_cell(point, params.width, params.height)) return false;
  const float limit = point.z + kLooksThrough * (params.footprint * point.z);
  const float* upper = depth.row(static_cast<int>(point.v)) + static_cast<int>(point.u);
  const float* lower = upper + depth.width;
  const auto is_behind = [limit](float d) { return d <= 0.0F || d > limit; };
  const bool any = upper[0] > 0.0F || upper[1] > 0.0F || lower[0] > 0.0F || lower[1] > 0.0F;
  return any && is_behind(upper[0]) && is_behind(upper[1]) && is_behind(lower[0]) && is_behind(lower[1]);
}

constexpr int kPixels = 64;  // of a row, side by side

template <typename T>
using Lanes = std::array<T, kPixels>;

/// Pixels of a view's row, and what the other view says of their depths.
struct ConfirmLanes {
  Lanes<float> depth;
  Lanes<float> u, v, z;      ///< SeenPoint
  Lanes<std::int32_t> cell;  ///< of the other view, in which the point lies; 0 if in none
  Lanes<std::int32_t> is_in_cell;
  std::array<Lanes<float>, 4> corner;  ///< depths of the cell
  Lanes<std::int32_t> said;
  Lanes<std::int32_t> asks;  ///< 1: the other view sees something in front
};

/// Where the depths of row y from x on lie in the other view.
[[gnu::always_inline]] inline void see_lanes(const ConfirmDepthsParams& params, int x, int y, int count,
                                             ConfirmLanes& lanes) {
  const PlaneWarp warp = params.warp;
  const int width = params.other_width;
  const int height = params.other_height;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const SeenPoint point = see_from(warp, static_cast<float>(x + i), static_cast<float>(y), lanes.depth[k]);
    const bool in_cell = is_in_a_cell(point, width, height);
    const bool inside = (lanes.depth[k] > 0.0F) & in_cell;
    lanes.u[k] = kept_if(inside, point.u);
    lanes.v[k] = kept_if(inside, point.v);
    lanes.z[k] = kept_if(inside, point.z);
    lanes.cell[k] = static_cast<int>(lanes.v[k]) * width + static_cast<int>(lanes.u[k]);
    lanes.is_in_cell[k] = static_cast<std::int32_t>(inside);
  }
}

/// What the other view says of the depths. Twin: support_of in shaders/confirm_depths.comp.
[[gnu::always_inline]] inline void weigh_lanes(const ConfirmDepthsParams& params, int count, ConfirmLanes& lanes) {
  const float max_step = params.other_max_step;
  const float share = params.other_footprint;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const float fx = lanes.u[k] - static_cast<float>(static_cast<int>(lanes.u[k]));
    const float fy = lanes.v[k] - static_cast<float>(static_cast<int>(lanes.v[k]));
    const float d0 = lanes.corner[0][k];
    const float d1 = lanes.corner[1][k];
    const float d2 = lanes.corner[2][k];
    const float d3 = lanes.corner[3][k];
    // Depth of the other view's surface at (u, v): interpolated in a cell without a step, else that of the nearest
    // pixel.
    const bool upper = joined(d0, d1, max_step, 1.0F);
    const bool left = joined(d0, d2, max_step, 1.0F);
    const bool right = joined(d1, d3, max_step, 1.0F);
    const bool lower = joined(d2, d3, max_step, 1.0F);
    const bool whole = upper & left & right & lower;
    const float nearest = fy < 0.5F ? (fx < 0.5F ? d0 : d1) : (fx < 0.5F ? d2 : d3);
    const float top = d0 + fx * (d1 - d0);
    const float bottom = d2 + fx * (d3 - d2);
    const float interpolated = top + fy * (bottom - top);
    const float seen = whole ? interpolated : nearest;
    const bool sees = (lanes.is_in_cell[k] != 0) & (seen > 0.0F);
    const float footprint = share * lanes.z[k];
    const float behind = seen - lanes.z[k];
    const float apart = behind < 0.0F ? -behind : behind;
    const auto add = [](bool condition, int support) { return static_cast<int>(condition) * support; };
    const int support = add(behind > kLooksThrough * footprint, kSupportOfLookingThrough) +
                        add(apart <= kAgreement * footprint, kSupportOfAgreement) +
                        add(apart <= kCloseAgreement * footprint, kSupportOfAgreement);
    lanes.said[k] = add(sees, support);
    lanes.asks[k] = static_cast<std::int32_t>(sees & (-behind > kLooksThrough * footprint));
  }
}

/// Whether the depth of this certainty at pixel (x, y) looks through a surer one of the other view, which sees it at a
/// point.
bool is_denied(const ViewDepths& view, const ViewDepths& other, const ConfirmDepthsParams& params,
               const SeenPoint& point, float certainty) {
  const float footprint = params.other_footprint * point.z;
  const int x = static_cast<int>(point.u + 0.5F);
  const int y = static_cast<int>(point.v + 0.5F);
  const float front = other.depth.at(x, y);
  return front > 0.0F && point.z - front > kLooksThrough * footprint && other.certainty.at(x, y) > certainty &&
         looks_through(view.depth, params, x, y, front);
}

/// Some pixels of a row.
void confirm_lanes(const ViewDepths& view, const ViewDepths& other, const ConfirmDepthsParams& params, int x, int y,
                   int count, SimdLevel simd, int* support) {
  thread_local const auto lanes = std::make_unique<ConfirmLanes>();
  std::copy_n(view.depth.row(y) + x, count, lanes->depth.begin());
  simd_form<see_lanes>(simd)(params, x, y, count, *lanes);
  const float* depth = other.depth.values.data();
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const float* upper = depth + lanes->cell[k];
    const float* lower = upper + other.depth.width;
    lanes->corner[0][k] = upper[0];
    lanes->corner[1][k] = upper[1];
    lanes->corner[2][k] = lower[0];
    lanes->corner[3][k] = lower[1];
  }
  simd_form<weigh_lanes>(simd)(params, count, *lanes);
  const bool finds_denials = (params.steps & kFindsDenials) != 0U;
  const bool adds = (params.steps & kFirstOfViews) == 0U;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    int said = lanes->said[k];
    if (finds_denials && lanes->asks[k] != 0 &&
        is_denied(view, other, params, {lanes->u[k], lanes->v[k], lanes->z[k]}, view.certainty.at(x + i, y)))
      said += kSupportOfDenial;
    support[i] = (adds ? support[i] : 0) + said;
  }
}

}  // namespace

ConfirmDepthsParams make_confirm_depths_params(const ConfirmTask& task, std::size_t other) {
  const ViewDepths& view = *task.view;
  const ViewDepths& seen_by = *task.others[other];
  const auto footprint_of = [](const Camera& camera) {
    return static_cast<float>(2.0 / (camera.intrinsics(0, 0) + camera.intrinsics(1, 1)));
  };
  const bool has_certainties = !view.certainty.empty() && !seen_by.certainty.empty();
  return {make_plane_warp(view.camera, seen_by.camera),
          make_plane_warp(seen_by.camera, view.camera),
          view.depth.width,
          view.depth.height,
          seen_by.depth.width,
          seen_by.depth.height,
          make_range_surface_params(seen_by.camera, seen_by.depth.width, seen_by.depth.height, task.fusion).max_step,
          footprint_of(view.camera),
          footprint_of(seen_by.camera),
          (other == 0 ? kFirstOfViews : 0U) | (has_certainties ? kFindsDenials : 0U)};
}

void confirm_depths(const ViewDepths& view, const ViewDepths& other, const ConfirmDepthsParams& params, SimdLevel simd,
                    Grid<int>& support) {
  if (other.depth.width < 2 || other.depth.height < 2) {  // has no cell
    if ((params.steps & kFirstOfViews) != 0U) std::ranges::fill(support.values, 0);
    return;
  }
  tbb::parallel_for(0, params.height, [&](int y) {
    for (int x = 0; x < params.width; x += kPixels)
      confirm_lanes(view, other, params, x, y, std::min(kPixels, params.width - x), simd, support.row(y) + x);
  });
}

float certainty_of(int support) {
  constexpr int kLeast = kConfirmingViews * kSupportOfLookingThrough;
  constexpr int kMost = kConfirmingViews * 2 * kSupportOfAgreement;
  // In 1/256.
  constexpr std::array<int, kMost - kLeast + 1> kCertainty = {8,   17,  34,  47,  80,  123, 133, 184, 197, 211, 220,
                                                              233, 238, 243, 247, 249, 251, 253, 254, 254, 254, 255,
                                                              255, 255, 255, 255, 255, 255, 255, 255, 255};
  constexpr float kUnit = 0.00390625F;
  if (support < kSupportOfDenial / 2) return 0.0F;
  QUORUM_CHECK_GE(support, kLeast);
  QUORUM_CHECK_LE(support, kMost);
  return static_cast<float>(kCertainty[static_cast<std::size_t>(support - kLeast)]) * kUnit;
}

Grid<float> certainty_map(const Grid<float>& depth, const Grid<int>& support) {
  Grid<float> certainty(depth.width, depth.height);
  tbb::parallel_for(std::size_t{0}, depth.values.size(), [&](std::size_t pixel) {
    if (depth.values[pixel] > 0.0F) certainty.values[pixel] = certainty_of(support.values[pixel]);
  });
  return certainty;
}

Grid<float> confirm_depths(const ConfirmTask& task, SimdLevel simd) {
  const Grid<float>& depth = task.view->depth;
  Grid<int> support(depth.width, depth.height);
  for (std::size_t other = 0; other < task.others.size(); ++other)
    confirm_depths(*task.view, *task.others[other], make_confirm_depths_params(task, other), simd, support);
  return certainty_map(depth, support);
}

}  // namespace quorum
