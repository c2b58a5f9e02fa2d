#include "engine/volume/confirm_depths.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>

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

/// What the other view says of depth d at pixel (x, y). Twin: support_of in shaders/confirm_depths.comp.
int support_of(const Grid<float>& other, const ConfirmDepthsParams& params, int x, int y, float d) {
  const PlaneWarp& warp = params.warp;
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  const float rx = warp.rotation[0] * fx + (warp.rotation[1] * fy + warp.rotation[2]);
  const float ry = warp.rotation[3] * fx + (warp.rotation[4] * fy + warp.rotation[5]);
  const float rz = warp.rotation[6] * fx + (warp.rotation[7] * fy + warp.rotation[8]);
  const float z = rz * d + warp.offset[2];
  if (!(z > kMinDepthRatio * d)) return 0;
  const float inverse_z = reciprocal(z);
  const float u = (rx * d + warp.offset[0]) * inverse_z;
  const float v = (ry * d + warp.offset[1]) * inverse_z;
  if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(params.other_width - 1) &&
        v < static_cast<float>(params.other_height - 1)))
    return 0;
  const float seen = surface_depth(other, u, v, params.other_max_step);
  if (!(seen > 0.0F)) return 0;
  const float footprint = params.footprint * z;
  const float behind = seen - z;
  const float apart = behind < 0.0F ? -behind : behind;
  return (behind > kLooksThrough * footprint ? kSupportOfLookingThrough : 0) +
         (apart <= kAgreement * footprint ? kSupportOfAgreement : 0) +
         (apart <= kCloseAgreement * footprint ? kSupportOfAgreement : 0);
}

}  // namespace

ConfirmDepthsParams make_confirm_depths_params(const ConfirmTask& task, std::size_t other) {
  const ViewDepths& seen_by = task.others[other];
  const Eigen::Matrix3d& k = seen_by.camera.intrinsics;
  return {make_plane_warp(task.view.camera, seen_by.camera),
          task.view.depth.width,
          task.view.depth.height,
          seen_by.depth.width,
          seen_by.depth.height,
          make_range_surface_params(seen_by.camera, seen_by.depth.width, seen_by.depth.height, task.fusion).max_step,
          static_cast<float>(2.0 / (k(0, 0) + k(1, 1))),
          other == 0 ? 1 : 0};
}

void confirm_depths(const Grid<float>& depth, const Grid<float>& other, const ConfirmDepthsParams& params,
                    Grid<int>& support) {
  tbb::parallel_for(0, params.height, [&](int y) {
    for (int x = 0; x < params.width; ++x) {
      const float d = depth.at(x, y);
      const int sum = params.is_first != 0 ? 0 : support.at(x, y);
      support.at(x, y) = d > 0.0F ? sum + support_of(other, params, x, y, d) : 0;
    }
  });
}

float certainty_of(int support) {
  constexpr int kLeast = kConfirmingViews * kSupportOfLookingThrough;
  constexpr int kMost = kConfirmingViews * 2 * kSupportOfAgreement;
  // In 1/256.
  constexpr std::array<int, kMost - kLeast + 1> kCertainty = {9,   17,  35,  47,  88,  103, 103, 186, 186, 209, 210,
                                                              231, 231, 241, 241, 248, 248, 253, 253, 253, 253, 255,
                                                              255, 255, 255, 255, 255, 255, 255, 255, 255};
  constexpr float kUnit = 0.00390625F;
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
  Grid<int> support(task.view.depth.width, task.view.depth.height);
  for (std::size_t other = 0; other < task.others.size(); ++other)
    confirm_depths(task.view.depth, task.others[other].depth, make_confirm_depths_params(task, other), support);
  return certainty_map(task.view.depth, support);
}

}  // namespace quorum
