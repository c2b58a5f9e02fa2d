// Adds one range surface to the voxels of the listed blocks: one invocation per voxel (the paper, section 2.2).
// Twin: engine/volume/integrate.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/exact.glsl"
#include "lib/cell.glsl"
#include "lib/sample_bilinear.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;
layout(push_constant) uniform Push { IntegrateParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };
layout(std430, binding = 2) readonly buffer Weights { uint weights[]; };
layout(std430, binding = 3) readonly buffer Image { uint pixels[]; };
layout(std430, binding = 4) readonly buffer List { uvec2 list[]; };  // block index, slot in the pool
layout(std430, binding = 5) buffer Pool { int pool[]; };

void main() {
  int local = int(gl_GlobalInvocationID.x);
  if (local >= kBlockVoxels) return;
  uvec2 entry = list[p.list_begin + int(gl_GlobalInvocationID.y)];
  int index = int(entry.x);
  int slot = int(entry.y) - p.pool_begin;
  float x = float(index % p.blocks[0] * kBlockSide + local % kBlockSide);
  float y = float(index / p.blocks[0] % p.blocks[1] * kBlockSide + local / kBlockSide % kBlockSide);
  float z = float(index / (p.blocks[0] * p.blocks[1]) * kBlockSide + local / (kBlockSide * kBlockSide));

  precise float pz = p.projection[8] * x + (p.projection[9] * y + (p.projection[10] * z + p.projection[11]));
  if (!(pz > 0.0)) return;
  precise float px = p.projection[0] * x + (p.projection[1] * y + (p.projection[2] * z + p.projection[3]));
  precise float py = p.projection[4] * x + (p.projection[5] * y + (p.projection[6] * z + p.projection[7]));
  float inverse_z = reciprocal(pz);
  precise float u = px * inverse_z;
  precise float v = py * inverse_z;
  if (!(u >= 0.0 && v >= 0.0 && u < float(p.width - 1) && v < float(p.height - 1))) return;
  int column = int(u);
  int row = int(v);
  precise vec2 fraction = vec2(u - float(column), v - float(row));

  int pixel = row * p.width + column;
  uint cell = cells[pixel];
  bool split_03 = (cell & kCellSplitAlong03) != 0u;
  precise float fraction_sum = fraction.x + fraction.y;
  bool second = split_03 ? fraction.x < fraction.y : fraction_sum > 1.0;
  if ((cell & (second ? kCellSecondTriangle : kCellFirstTriangle)) == 0u) return;
  vec4 depths = vec4(depth[pixel], depth[pixel + 1], depth[pixel + p.width], depth[pixel + p.width + 1]);
  vec4 corner_weights =
      vec4(uvec4(weights[pixel], weights[pixel + 1], weights[pixel + p.width], weights[pixel + p.width + 1]));

  precise float ray_x = (u - p.principal_x) * p.inverse_focal_x;
  precise float ray_y = (v - p.principal_y) * p.inverse_focal_y;
  precise float ray_squared = ray_x * ray_x + (ray_y * ray_y + 1.0);
  precise float ray_length = ray_squared * reciprocal_sqrt(ray_squared);
  precise float distance =
      ((interpolate_cell(split_03, second, depths, fraction) - pz) * ray_length) * p.inverse_truncation;
  if (!(distance >= -kBehindShare && distance <= 1.0)) return;
  float scale = float(kDistanceScale);
  precise float scaled_distance = distance * scale + (scale + 0.5);
  int signed_distance = int(scaled_distance) - kDistanceScale;
  precise float rounded_weight = interpolate_cell(split_03, second, corner_weights, fraction) + 0.5;
  int weight = int(rounded_weight);

  precise float sample_u = u * float(kPositionScale) + 0.5;
  precise float sample_v = v * float(kPositionScale) + 0.5;
  int iu = int(sample_u);
  int iv = int(sample_v);
  int stride = p.width + 1;
  int texel = (iv >> kPositionBits) * stride + (iu >> kPositionBits);
  ivec3 color = sample_bilinear(pixels[texel], pixels[texel + 1], pixels[texel + stride], pixels[texel + stride + 1],
                                iu, iv, kSampleShift);
  color = min((color + 2048 + 8) >> 4, ivec3(255));

  int voxel = (slot * kBlockVoxels + local) * kVoxelWords;
  pool[voxel] += weight;
  pool[voxel + 1] += weight * signed_distance;
  pool[voxel + 2] += weight * color.x;
  pool[voxel + 3] += weight * color.y;
  pool[voxel + 4] += weight * color.z;
}
