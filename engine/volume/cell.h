// Cells of a range surface: triangles and interpolation. Twin: shaders/lib/cell.glsl.
#pragma once

#include <cstdint>

#include "shaders/layout.h"

namespace quorum {

constexpr float kDiagonal = 1.41421356F;

/// True if both depths exist and differ by no more than the slope allows over pixels of image distance.
[[gnu::always_inline]] inline bool joined(float a, float b, float max_step, float pixels) {
  const float nearer = a < b ? a : b;
  const float difference = a < b ? b - a : a - b;
  return (nearer > 0.0F) & (difference <= (max_step * nearer) * pixels);
}

/// True if a cell with these depths at its corners is split from corner 0 to corner 3: the shorter diagonal.
inline bool is_split_03(float d0, float d1, float d2, float d3) {
  const bool has_12 = d1 > 0.0F && d2 > 0.0F;
  const bool has_03 = d0 > 0.0F && d3 > 0.0F;
  const float step_12 = d1 < d2 ? d2 - d1 : d1 - d2;
  const float step_03 = d0 < d3 ? d3 - d0 : d0 - d3;
  return has_03 && (!has_12 || step_03 < step_12);
}

/// Bits kCell… of a cell whose sides and diagonal are joined or not.
inline std::uint32_t cell_bits(bool split_03, bool top, bool left, bool right, bool bottom, bool diagonal) {
  const bool first = diagonal && top && (split_03 ? right : left);
  const bool second = diagonal && bottom && (split_03 ? left : right);
  return (first ? kCellFirstTriangle : 0U) | (second ? kCellSecondTriangle : 0U) |
         (split_03 && (first || second) ? kCellSplitAlong03 : 0U);
}

/// A value at (fraction_x, fraction_y) in a cell, linear on the triangle that holds it.
[[gnu::always_inline]] inline float interpolate_cell(bool split_03, bool second, float v0, float v1, float v2, float v3,
                                                     float fraction_x, float fraction_y) {
  const float split_03_value = second ? v0 + (fraction_y * (v2 - v0) + fraction_x * (v3 - v2))
                                      : v0 + (fraction_x * (v1 - v0) + fraction_y * (v3 - v1));
  const float split_12_value = second ? v3 + ((1.0F - fraction_x) * (v2 - v3) + (1.0F - fraction_y) * (v1 - v3))
                                      : v0 + (fraction_x * (v1 - v0) + fraction_y * (v2 - v0));
  return split_03 ? split_03_value : split_12_value;
}

}  // namespace quorum
