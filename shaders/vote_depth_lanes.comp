// The same votes as vote_depth.comp, in the form for software Vulkan: what it reads most comes as texels.
// Twin: engine/depth/vote_depth.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "layout.h"

layout(push_constant) uniform Push { VoteParams p; };
layout(std430, binding = 0) readonly buffer Blocks { SweepBlock blocks[]; };
layout(binding = 1) uniform usamplerBuffer items;  // SweepItem
layout(std430, binding = 2) readonly buffer Ranges { PlaneRange ranges[]; };
layout(binding = 3) uniform usamplerBuffer ncc_values;
layout(std430, binding = 4) buffer Votes { PixelVote votes[]; };

int plane_of_item(int item) { return int(texelFetch(items, item).z); }
vec4 ncc_of_quad(int quad) { return uintBitsToFloat(texelFetch(ncc_values, quad)); }

#include "lib/vote_for_block.glsl"
