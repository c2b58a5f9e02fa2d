// Cells of a range surface: triangles and interpolation. Twin: engine/volume/cell.h.

const float kDiagonal = 1.41421356;

// True if both depths exist and differ by no more than the slope allows over pixels of image distance.
bool joined(float a, float b, float max_step, float pixels) {
  float nearer = a < b ? a : b;
  precise float difference = a < b ? b - a : a - b;
  precise float limit = (max_step * nearer) * pixels;
  return nearer > 0.0 && difference <= limit;
}

// True if a cell with these depths at its corners is split from corner 0 to corner 3: the shorter diagonal.
bool is_split_03(float d0, float d1, float d2, float d3) {
  bool has_12 = d1 > 0.0 && d2 > 0.0;
  bool has_03 = d0 > 0.0 && d3 > 0.0;
  precise float step_12 = d1 < d2 ? d2 - d1 : d1 - d2;
  precise float step_03 = d0 < d3 ? d3 - d0 : d0 - d3;
  return has_03 && (!has_12 || step_03 < step_12);
}

uint cell_bits(bool split_03, bool top, bool left, bool right, bool bottom, bool diagonal) {
  bool first = diagonal && top && (split_03 ? right : left);
  bool second = diagonal && bottom && (split_03 ? left : right);
  return (first ? kCellFirstTriangle : 0u) | (second ? kCellSecondTriangle : 0u) |
         (split_03 && (first || second) ? kCellSplitAlong03 : 0u);
}

// A value at (fraction.x, fraction.y) in a cell with these values at its corners, linear on the triangle that holds it.
float interpolate_cell(bool split_03, bool second, vec4 v, vec2 fraction) {
  precise float result;
  if (split_03) {
    if (second) result = v.x + (fraction.y * (v.z - v.x) + fraction.x * (v.w - v.z));
    else result = v.x + (fraction.x * (v.y - v.x) + fraction.y * (v.w - v.y));
  } else {
    if (second) result = v.w + ((1.0 - fraction.x) * (v.z - v.w) + (1.0 - fraction.y) * (v.y - v.w));
    else result = v.x + (fraction.x * (v.y - v.x) + fraction.y * (v.z - v.x));
  }
  return result;
}
