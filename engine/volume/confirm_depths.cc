#include "engine/volume/confirm_depths.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/exact.h"
#include "engine/depth/plane_warp.h"
#include "engine/volume/cell.h"
#include "engine/volume/range_surface.h"

namespace quorum {
namespace {

/// Depth of a view's surface at (u, v), which lies between four of its pixels. Twin: surface_depth in
/// shaders/confirm_depths.comp.
float surface_depth(const Grid<float>& depth, float u, float v, float max_step) {
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  const float fx = u - static_cast<float>(x);
  const float fy = v - static_cast<float>(y);
  const float* upper = depth.row(y) + x;
  const float* lower = upper + depth.width;
  const float d0 = upper[0];
  const float d1 = upper[1];
  const float d2 = lower[0];
  const float d3 = lower[1];
  const bool whole = joined(d0, d1, max_step, 1.0F) && joined(d0, d2, max_step, 1.0F) &&
                     joined(d1, d3, max_step, 1.0F) && joined(d2, d3, max_step, 1.0F);
  if (!whole) return fy < 0.5F ? (fx < 0.5F ? d0 : d1) : (fx < 0.5F ? d2 : d3);
  const float top = d0 + fx * (d1 - d0);
  const float bottom = d2 + fx * (d3 - d2);
  return top + fy * (bottom - top);
}

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
bool is_in_a_cell(const SeenPoint& point, int width, int height) {
  return point.z > 0.0F && point.u >= 0.0F && point.v >= 0.0F && point.u < static_cast<float>(width - 1) &&
         point.v < static_cast<float>(height - 1);
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

/// What the other view says of a depth of this certainty that it has at a point. Twin: support_of in
/// shaders/confirm_depths.comp.
int support_of(const ViewDepths& view, const ViewDepths& other, const ConfirmDepthsParams& params,
               const SeenPoint& point, float certainty) {
  if (!is_in_a_cell(point, params.other_width, params.other_height)) return 0;
  const float seen = surface_depth(other.depth, point.u, point.v, params.other_max_step);
  if (!(seen > 0.0F)) return 0;
  const float footprint = params.other_footprint * point.z;
  const float behind = seen - point.z;
  const float apart = behind < 0.0F ? -behind : behind;
  int support = (behind > kLooksThrough * footprint ? kSupportOfLookingThrough : 0) +
                (apart <= kAgreement * footprint ? kSupportOfAgreement : 0) +
                (apart <= kCloseAgreement * footprint ? kSupportOfAgreement : 0);
  if ((params.steps & kFindsDenials) != 0U && -behind > kLooksThrough * footprint) {
    const int x = static_cast<int>(point.u + 0.5F);
    const int y = static_cast<int>(point.v + 0.5F);
    const float front = other.depth.at(x, y);
    if (front > 0.0F && point.z - front > kLooksThrough * footprint && other.certainty.at(x, y) > certainty &&
        looks_through(view.depth, params, x, y, front))
      support += kSupportOfDenial;
  }
  return support;
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

void confirm_depths(const ViewDepths& view, const ViewDepths& other, const ConfirmDepthsParams& params,
                    Grid<int>& support) {
  const bool finds_denials = (params.steps & kFindsDenials) != 0U;
  const bool adds = (params.steps & kFirstOfViews) == 0U;
  tbb::parallel_for(0, params.height, [&](int y) {
    thread_local std::vector<SeenPoint> points;
    points.resize(static_cast<std::size_t>(params.width));
    const float* depth = view.depth.row(y);
    int* sums = support.row(y);
    for (int x = 0; x < params.width; ++x)
      points[static_cast<std::size_t>(x)] =
          see_from(params.warp, static_cast<float>(x), static_cast<float>(y), depth[x]);
    for (int x = 0; x < params.width; ++x) {
      const float certainty = finds_denials ? view.certainty.at(x, y) : 0.0F;
      const int said =
          depth[x] > 0.0F ? support_of(view, other, params, points[static_cast<std::size_t>(x)], certainty) : 0;
      sums[x] = (adds ? sums[x] : 0) + said;
    }
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
  for (std::size_t pixel = 0; pixel < depth.values.size(); ++pixel)
    if (depth.values[pixel] > 0.0F) certainty.values[pixel] = certainty_of(support.values[pixel]);
  return certainty;
}

Grid<float> confirm_depths(const ConfirmTask& task) {
  const Grid<float>& depth = task.view->depth;
  Grid<int> support(depth.width, depth.height);
  for (std::size_t other = 0; other < task.others.size(); ++other)
    confirm_depths(*task.view, *task.others[other], make_confirm_depths_params(task, other), support);
  return certainty_map(depth, support);
}

}  // namespace quorum
