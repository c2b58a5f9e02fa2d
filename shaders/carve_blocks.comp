// Marks the voxels of the listed blocks that a view looks through (Curless and Levoy 1996, section 4). An invocation
// takes 32 voxels of a block, which share a word.
// Twin: engine/volume/carve_blocks.cc.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layout.h"
#include "lib/exact.glsl"
#include "lib/cell.glsl"

layout(local_size_x = 64, local_size_y = 1, local_size_z = 1) in;  // four blocks
layout(push_constant) uniform Push { IntegrateParams p; };
layout(std430, binding = 0) readonly buffer Depth { float depth[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };
layout(std430, binding = 2) readonly buffer Weights { uint weights[]; };
layout(std430, binding = 3) readonly buffer List { uint list[]; };  // block indices
layout(std430, binding = 4) buffer Empty { uint empty[]; };         // bit x + 8 (y % 4) of word 2 z + y / 4

#include "lib/voxel_on_surface.glsl"

const int kWordsOfBlock = kBlockVoxels / 32;

// True if the position lies between four pixels of the background.
bool on_background(VoxelOnSurface voxel, int width, int last_pixel) {
  int corner = voxel.pixel != last_pixel ? voxel.pixel : 0;
  return voxel.pixel != last_pixel && depth[corner] < 0.0 && depth[corner + 1] < 0.0 && depth[corner + width] < 0.0 &&
         depth[corner + width + 1] < 0.0;
}

void main() {
  int entry = int(gl_GlobalInvocationID.x) / kWordsOfBlock;
  int word = int(gl_GlobalInvocationID.x) % kWordsOfBlock;
  if (entry >= list.length()) return;
  int index = int(list[entry]);
  ivec3 first = first_voxel(index) + ivec3(0, word % 2 * 4, word / 2);
  Projector projector = make_projector();
  int width = p.width;
  float limit_u = float(p.width - 1);
  float limit_v = float(p.height - 1);
  int last_pixel = p.width * p.height - 1;  // has no triangle

  uint bits = 0u;
  for (int i = 0; i < 32; ++i) {
    Position at = project_voxel(projector, float(first.x + i % kBlockSide), float(first.y + i / kBlockSide),
                                float(first.z));
    VoxelOnSurface voxel = find_on_surface(at, width, limit_u, limit_v, last_pixel);
    bool before = voxel.on_surface && distance_before(voxel, at, width) > 1.0;
    if (before || on_background(voxel, width, last_pixel)) bits |= 1u << i;
  }
  int place = (index - p.pool_begin) * kWordsOfBlock + word;
  if (bits != 0u) empty[place] |= bits;
}
