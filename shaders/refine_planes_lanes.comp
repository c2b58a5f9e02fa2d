// A round of planes that every pixel tries, in the form for software Vulkan, which runs invocations as the lanes of
// vector instructions: an invocation goes down a column, at each pixel through the moves of the round, and for each
// move through the neighbors, until a trial can't win any more. As one loop over windows, not three nested ones, so
// that a lane goes on with its next window as soon as it has done one. Memory comes as texels
// (sweep_depth_lanes.comp).
// Twin: engine/depth/refine_planes.cc. The form for GPUs: refine_planes.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "layout.h"
#include "lib/place_window.glsl"
#include "lib/plane_moves.glsl"
#include "lib/sample_bilinear.glsl"
#define NCC_IN_DOUBLES
#include "lib/ncc_from_sums.glsl"

layout(local_size_x = 8, local_size_y = 1, local_size_z = 1) in;
layout(constant_id = 0) const int kWindow = 5;
layout(constant_id = 1) const int kShift = 12;  // kSampleShift, one more for the largest windows

layout(push_constant) uniform Push { RefinePlanesLanesParams p; };
layout(binding = 0) uniform usamplerBuffer moves;      // PlaneMove
layout(binding = 1) uniform usamplerBuffer neighbors;  // PlaneNeighbor
layout(binding = 2) uniform usamplerBuffer pixels;     // PlanePixel
layout(binding = 3) uniform usamplerBuffer quads;      // the four texels of a sample: reference, then neighbors
layout(binding = 4) uniform usamplerBuffer last;       // PlaneTexel
layout(std430, binding = 5) writeonly buffer Planes { vec4 planes[]; };               // PlaneTexel
layout(std430, binding = 6) writeonly buffer Correlations { float correlations[]; };  // of the planes

const int kLanes = 8;  // of a work group, which takes as many columns
const int kRadius = kWindow / 2;

PixelPlane plane_of(uvec4 texel) {
  float confidence = uintBitsToFloat(texel.w);
  return PixelPlane(uintBitsToFloat(texel.x), uintBitsToFloat(texel.y), uintBitsToFloat(texel.z), 0.0, abs(confidence),
                    confidence < 0.0 ? 1 : 0);
}

// A window of the reference, the colors that belong to its support, and where it lands.
struct Window {
  int reference;  // quad of its first pixel
  int reference_width;
  uint middle;  // its center
  int max_difference;
  int first_quad;  // of the neighbor
  int neighbor_width;
  ivec2 corner;  // where its first pixel lands, and the steps from there
  ivec2 step_x;
  ivec2 step_y;
};

// Adds a row of samples, where they belong to the support, and the one below it unless it is the last, so that a quad
// of the reference serves both.
void add_rows(inout WindowSums sums, Window window, int row) {
  uvec4 quads_of_rows[kRadius + 1];
  [[unroll]] for (int i = 0; i <= kRadius; ++i)
    quads_of_rows[i] = texelFetch(quads, window.reference + row * window.reference_width + 2 * i);
  [[unroll]] for (int k = 0; k < 2; ++k) {
    bool is_inside = row + k < kWindow;
    int dy = is_inside ? row + k : row;
    [[unroll]] for (int i = 0; i < kWindow; ++i) {
      ivec2 position = place_sample(window.corner, window.step_x, window.step_y, i, dy);
      int quad_index = texel_index(position.x, position.y, window.neighbor_width);
      uvec4 quad = texelFetch(quads, window.first_quad + quad_index);
      ivec3 b = sample_bilinear(quad.x, quad.y, quad.z, quad.w, position.x, position.y, kShift);
      uint pixel = quads_of_rows[i / 2][2 * k + i % 2];
      bool belongs = is_inside && largest_difference(pixel, window.middle) <= window.max_difference;
      add_sample(sums, sample_pixel(pixel, kShift), belongs ? b : ivec3(0));
    }
  }
}

// A function of its own, because `precise` in the loop of main makes glslang 12 follow assignments without end.
float add(float x, float y) {
  precise float sum = x + y;
  return sum;
}

void main() {
  // Parameters are read here because under a mask, and so in a loop, a read takes each lane by itself.
  int width = p.width;
  int height = p.height;
  int move_count = p.move_count;
  int neighbor_count = p.neighbor_count;
  bool is_first = p.is_first != 0;
  int min_votes = p.min_votes;
  float max_tilt = p.max_tilt;
  float threshold = p.threshold;
  float confidence_scale = p.confidence_scale;
  int columns = (width + kLanes - 1) / kLanes;
  int rows = int(gl_WorkGroupID.x) / columns;  // of strips
  int x = (int(gl_WorkGroupID.x) - rows * columns) * kLanes + int(gl_LocalInvocationID.x);
  int y_begin = p.row_begin + rows * p.rows_per_lane;
  int y_end = x < width ? min(y_begin + p.rows_per_lane, p.row_end) : y_begin;
  int first_pixel = p.first_pixel;

  const PixelPlane none = PixelPlane(0.0, 0.0, 0.0, 0.0, 0.0, 0);
  int y = y_begin - 1;
  PixelPlane best = none;
  InverseDepthRange range = InverseDepthRange(1.0, 0.0);
  ReferenceWindow reference = ReferenceWindow(int[3](0, 0, 0), 0.0);
  int samples = 0;
  int max_difference = 0;
  uint middle = 0u;
  int move_index = move_count;
  PlaneTrial trial = kNoTrial;
  int neighbor = 0;
  bool done = false;
  bool trying = false;
  while (!done) {
    while (!trying && !done) {
      // A loop of one round: software Vulkan skips a loop that no lane of a vector enters, but not a condition.
      for (int once = move_index == move_count ? 0 : 1; once < 1; ++once) {
        if (y >= y_begin) {
          bool taken = best.taken_by != 0;
          int index = y * width + x - first_pixel;
          planes[index] =
              vec4(best.inverse_depth, best.slope_x, best.slope_y, taken ? -best.confidence : best.confidence);
          if (taken) correlations[index] = best.correlation;
        }
        ++y;
        done = y >= y_end;
        int pixel = done ? 0 : y * width + x;
        uvec4 support = texelFetch(pixels, 2 * pixel);
        uvec4 rest = texelFetch(pixels, 2 * pixel + 1);
        reference =
            ReferenceWindow(int[3](int(support.x), int(support.y), int(support.z)), uintBitsToFloat(support.w));
        samples = int(rest.x);
        max_difference = int(rest.y);
        range = InverseDepthRange(uintBitsToFloat(rest.z), uintBitsToFloat(rest.w));
        middle = texelFetch(quads, pixel).x;
        best = none;
        if (!is_first) best = plane_of(texelFetch(last, pixel));
        best.taken_by = 0;
        move_index = range.farthest > range.nearest ? move_count : 0;
      }
      if (move_index < move_count && !done) {
        uvec4 step = texelFetch(moves, 2 * move_index);
        uvec4 rest = texelFetch(moves, 2 * move_index + 1);
        PlaneMove move = PlaneMove(int(step.x), int(step.y), uintBitsToFloat(step.z), uintBitsToFloat(step.w),
                                   uintBitsToFloat(rest.x), uintBitsToFloat(rest.y), uintBitsToFloat(rest.z),
                                   int(rest.w));
        int other_x = x + move.offset_x;
        int other_y = y + move.offset_y;
        bool inside = other_x >= 0 && other_y >= 0 && other_x < width && other_y < height;
        PixelPlane other = plane_of(texelFetch(last, inside ? other_y * width + other_x : 0));
        if (!inside) other = none;
        if (is_first) trial = PlaneTrial(other.inverse_depth, other.slope_x, other.slope_y, 0.0, 0);
        else trial = move_plane(move, best, other);
        trying = trial.inverse_depth != 0.0 && may_take(trial, range, max_tilt);
        neighbor = 0;
        ++move_index;
      }
    }
    if (done) break;
    uvec4 words = texelFetch(neighbors, 4 * neighbor);
    uvec4 words_1 = texelFetch(neighbors, 4 * neighbor + 1);
    uvec4 words_2 = texelFetch(neighbors, 4 * neighbor + 2);
    uvec4 image = texelFetch(neighbors, 4 * neighbor + 3);
    PlaneWarp warp;
    [[unroll]] for (int i = 0; i < 4; ++i) warp.rotation[i] = uintBitsToFloat(words[i]);
    [[unroll]] for (int i = 0; i < 4; ++i) warp.rotation[4 + i] = uintBitsToFloat(words_1[i]);
    warp.rotation[8] = uintBitsToFloat(words_2[0]);
    [[unroll]] for (int i = 0; i < 3; ++i) warp.offset[i] = uintBitsToFloat(words_2[1 + i]);
    int neighbor_width = int(image.x);
    WindowPlacement at = place_window(warp, x, y, trial.inverse_depth, trial.slope_x, trial.slope_y, kRadius,
                                      neighbor_width, int(image.y));
    ivec2 step_x = at.seen ? at.step_x : ivec2(0);
    ivec2 step_y = at.seen ? at.step_y : ivec2(0);
    ivec2 corner = (at.seen ? at.center : ivec2(0)) - kRadius * (step_x + step_y);
    Window window = Window((y - kRadius) * width + x - kRadius, width, middle, max_difference, int(image.z),
                           neighbor_width, corner, step_x, step_y);
    WindowSums sums = no_sums();
    if (kWindow <= 7) [[unroll]] for (int row = 0; row < kWindow; row += 2) add_rows(sums, window, row);
    else for (int row = 0; row < kWindow; row += 2) add_rows(sums, window, row);  // unrolled it takes long to compile
    float ncc = ncc_from_sums(reference, sums, samples);
    if (at.seen && ncc > threshold) {
      trial.ncc_sum = add(trial.ncc_sum, ncc);
      ++trial.votes;
    }
    ++neighbor;
    bool stays = can_win(trial.ncc_sum, trial.votes, neighbor_count - neighbor, best.confidence, min_votes, threshold,
                         confidence_scale);
    if (stays && neighbor == neighbor_count) best = taken_plane(trial, threshold, confidence_scale, move_index);
    trying = stays && neighbor < neighbor_count;
  }
}
