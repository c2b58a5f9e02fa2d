// Adds one range surface to the voxels of the listed blocks (the paper, section 2.2). An invocation takes a column of a
// block along z. First it measures all voxels of the column, without branches; then it goes through those within the
// truncation, so that what a voxel costs beyond its distance is paid for these alone.
// Twin: engine/volume/integrate.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "layout.h"
#include "lib/exact.glsl"
#include "lib/cell.glsl"
#include "lib/sample_bilinear.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;  // a block
layout(push_constant) uniform Push { IntegrateParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };
layout(std430, binding = 2) readonly buffer Weights { uint weights[]; };
layout(std430, binding = 3) readonly buffer Image { uint pixels[]; };
layout(std430, binding = 4) readonly buffer List { uvec2 list[]; };  // block index, slot in the pool
layout(std430, binding = 5) buffer Pool { int pool[]; };

// The projection, row by row.
struct Projector {
  vec4 x;
  vec4 y;
  vec4 z;
};

// Where a voxel lies in the view: pixels, and along the optical axis.
struct Position {
  float u;
  float v;
  float depth;
};

Position project_voxel(Projector m, float x, float y, float z) {
  precise float pz = m.z.x * x + (m.z.y * y + (m.z.z * z + m.z.w));
  precise float px = m.x.x * x + (m.x.y * y + (m.x.z * z + m.x.w));
  precise float py = m.y.x * x + (m.y.y * y + (m.y.z * z + m.y.w));
  float inverse_z = reciprocal(pz > 0.0 ? pz : 1.0);
  precise float u = px * inverse_z;
  precise float v = py * inverse_z;
  return Position(u, v, pz);
}

// What the first pass over a column leaves for the second, in 16 bits: signed distance + kDistanceScale, which is not 0
// within the truncation, and the triangle.
const uint kDistanceBits = 0x1fffu;
const uint kSplit03 = 0x2000u;
const uint kSecond = 0x4000u;

void main() {
  // The parameters are read here because software Vulkan reads them lane by lane inside of loops.
  int column = int(gl_GlobalInvocationID.x);
  uvec2 entry = list[p.list_begin + int(gl_GlobalInvocationID.y)];
  int index = int(entry.x);
  float x = float(index % p.blocks[0] * kBlockSide + column % kBlockSide);
  float y = float(index / p.blocks[0] % p.blocks[1] * kBlockSide + column / kBlockSide);
  int z = index / (p.blocks[0] * p.blocks[1]) * kBlockSide;
  int first_voxel = (int(entry.y) - p.pool_begin) * kBlockVoxels + column;
  Projector projector =
      Projector(vec4(p.projection[0], p.projection[1], p.projection[2], p.projection[3]),
                vec4(p.projection[4], p.projection[5], p.projection[6], p.projection[7]),
                vec4(p.projection[8], p.projection[9], p.projection[10], p.projection[11]));
  int width = p.width;
  float limit_u = float(p.width - 1);
  float limit_v = float(p.height - 1);
  int last_pixel = p.width * p.height - 1;  // has no triangle
  const float scale = float(kDistanceScale);
  const float mean_of_cosines = 0.5 / float(kCosineScale);

  uvec4 kept = uvec4(0u);
  uint near = 0u;  // bit i: the voxel of layer i is within the truncation
  [[unroll]] for (int layer = 0; layer < kBlockSide; ++layer) {
    Position at = project_voxel(projector, x, y, float(z + layer));
    bool inside = at.depth > 0.0 && at.u >= 0.0 && at.v >= 0.0 && at.u < limit_u && at.v < limit_v;
    int cell_x = int(inside ? at.u : 0.0);
    int cell_y = int(inside ? at.v : 0.0);
    precise vec2 fraction = vec2(at.u - float(cell_x), at.v - float(cell_y));
    int pixel = inside ? cell_y * width + cell_x : last_pixel;
    uint cell = cells[pixel];
    bool split_03 = (cell & kCellSplitAlong03) != 0u;
    precise float fraction_sum = fraction.x + fraction.y;
    bool second = split_03 ? fraction.x < fraction.y : fraction_sum > 1.0;
    bool on_surface = (cell & (second ? kCellSecondTriangle : kCellFirstTriangle)) != 0u;
    int corner = on_surface ? pixel : 0;
    vec4 depths = vec4(depth[corner], depth[corner + 1], depth[corner + width], depth[corner + width + 1]);

    precise float ray_x = (at.u - p.principal_x) * p.inverse_focal_x;
    precise float ray_y = (at.v - p.principal_y) * p.inverse_focal_y;
    precise float ray_squared = ray_x * ray_x + (ray_y * ray_y + 1.0);
    precise float ray_length = ray_squared * reciprocal_sqrt(ray_squared);
    // Both ends of the cell's diagonal.
    uint cosines = (weights[corner + (split_03 ? 0 : 1)] >> kWeightBits) +
                   (weights[corner + width + (split_03 ? 1 : 0)] >> kWeightBits);
    precise float cosine = float(int(cosines)) * mean_of_cosines;
    precise float distance =
        (((interpolate_cell(split_03, second, depths, fraction) - at.depth) * ray_length) * cosine) *
        p.inverse_truncation;
    bool is_near = on_surface && distance >= -kBehindShare && distance <= 1.0;
    precise float scaled_distance = (is_near ? distance : 0.0) * scale + (scale + 0.5);
    uint bits = uint(int(scaled_distance)) | (split_03 ? kSplit03 : 0u) | (second ? kSecond : 0u);
    kept[layer / 2] |= is_near ? bits << (layer % 2 * 16) : 0u;
    near |= is_near ? 1u << layer : 0u;
  }

  while (near != 0u) {
    int layer = findLSB(near);
    near &= near - 1u;
    uint bits = kept[layer / 2] >> (layer % 2 * 16);
    bool split_03 = (bits & kSplit03) != 0u;
    bool second = (bits & kSecond) != 0u;
    int signed_distance = int(bits & kDistanceBits) - kDistanceScale;
    Position at = project_voxel(projector, x, y, float(z + layer));
    int cell_x = int(at.u);
    int cell_y = int(at.v);
    precise vec2 fraction = vec2(at.u - float(cell_x), at.v - float(cell_y));
    int pixel = cell_y * width + cell_x;
    vec4 corner_weights =
        vec4(uvec4(weights[pixel], weights[pixel + 1], weights[pixel + width], weights[pixel + width + 1]) &
             uint(kWeightScale));
    precise float rounded_weight = interpolate_cell(split_03, second, corner_weights, fraction) + 0.5;
    int weight = int(rounded_weight);

    precise float sample_u = at.u * float(kPositionScale) + 0.5;
    precise float sample_v = at.v * float(kPositionScale) + 0.5;
    int iu = int(sample_u);
    int iv = int(sample_v);
    int stride = width + 1;
    int texel = (iv >> kPositionBits) * stride + (iu >> kPositionBits);
    ivec3 color = sample_bilinear(pixels[texel], pixels[texel + 1], pixels[texel + stride], pixels[texel + stride + 1],
                                  iu, iv, kSampleShift);
    color = min((color + 2048 + 8) >> 4, ivec3(255));

    int voxel = (first_voxel + layer * kBlockSide * kBlockSide) * kVoxelWords;
    pool[voxel] += weight;
    pool[voxel + 1] += weight * signed_distance;
    pool[voxel + 2] += weight * color.x;
    pool[voxel + 3] += weight * color.y;
    pool[voxel + 4] += weight * color.z;
  }
}
