// The votes of a batch of items: counts and sums over the neighbors, and the best plane of each pixel so far (the
// paper, section 2.1). Twin: engine/depth/vote_depth.h. The form for software Vulkan: vote_depth_lanes.comp.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "layout.h"

layout(push_constant) uniform Push { VoteParams p; };
layout(std430, binding = 0) readonly buffer Blocks { SweepBlock blocks[]; };
layout(std430, binding = 1) readonly buffer Items { SweepItem items[]; };
layout(std430, binding = 2) readonly buffer Ranges { PlaneRange ranges[]; };
layout(std430, binding = 3) readonly buffer Ncc { vec4 ncc_values[]; };
layout(std430, binding = 4) buffer Votes { PixelVote votes[]; };

int plane_of_item(int item) { return items[item].plane; }
vec4 ncc_of_quad(int quad) { return ncc_values[quad]; }

#include "lib/vote_for_block.glsl"
