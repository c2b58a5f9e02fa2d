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

#include "lib/voxel_on_surface.glsl"

// What the first pass over a column leaves for the second, in 16 bits: signed distance + kDistanceScale, which is not 0
// within the truncation, and the triangle.
const uint kDistanceBits = 0x1fffu;
const uint kSplit03 = 0x2000u;
const uint kSecond = 0x4000u;

void main() {
  // The parameters are read here because software Vulkan reads them lane by lane inside of loops.
  int column = int(gl_GlobalInvocationID.x);
  uvec2 entry = list[p.list_begin + int(gl_GlobalInvocationID.y)];
  ivec3 first = first_voxel(int(entry.x));
  float x = float(first.x + column % kBlockSide);
  float y = float(first.y + column / kBlockSide);
  int first_voxel = (int(entry.y) - p.pool_begin) * kBlockVoxels + column;
  Projector projector = make_projector();
  int width = p.width;
  float limit_u = float(p.width - 1);
  float limit_v = float(p.height - 1);
  int last_pixel = p.width * p.height - 1;  // has no triangle
  const float scale = float(kDistanceScale);

  uvec4 kept = uvec4(0u);
  uint near = 0u;  // bit i: the voxel of layer i is within the truncation
  [[unroll]] for (int layer = 0; layer < kBlockSide; ++layer) {
    Position at = project_voxel(projector, x, y, float(first.z + layer));
    VoxelOnSurface voxel = find_on_surface(at, width, limit_u, limit_v, last_pixel);
    precise float distance = distance_before(voxel, at, width);
    bool is_near = voxel.on_surface && distance >= -kBehindShare && distance <= 1.0;
    precise float scaled_distance = (is_near ? distance : 0.0) * scale + (scale + 0.5);
    uint bits = uint(int(scaled_distance)) | (voxel.split_03 ? kSplit03 : 0u) | (voxel.second ? kSecond : 0u);
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
    Position at = project_voxel(projector, x, y, float(first.z + layer));
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
    int texel = texel_index(iu, iv, stride);
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
