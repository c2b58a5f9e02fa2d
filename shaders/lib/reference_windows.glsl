// What NCC needs of a window of the reference. Twin: engine/depth/reference_windows.h.
#include "lib/ncc_from_sums.glsl"
#include "lib/sample_bilinear.glsl"

struct ReferenceSums {
  ivec3 sum;    // per channel
  int squares;  // all channels
};

void add_sample(inout ReferenceSums sums, ivec3 a) {
  sums.sum += a;
  sums.squares += product(a, a);
}

ReferenceWindow window_from_sums(ReferenceSums sums, int n) {
  float variance = scaled_covariance(n, sums.squares, sums.sum, sums.sum);
  return ReferenceWindow(int[3](sums.sum.x, sums.sum.y, sums.sum.z), reciprocal_sqrt(variance));
}
