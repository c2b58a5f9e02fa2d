// From the votes of a view to its depth map (the paper, section 2.1). Twin of shaders/vote_depth.comp.
#pragma once

#include "engine/depth/depth_map.h"
#include "engine/depth/sweep_task.h"
#include "engine/depth/vote.h"

namespace quorum {

VoteRule make_vote_rule(const SweepOptions& options, int neighbor_count);

/// No plane so far.
constexpr PixelVote kNoVote{0.0F, 0.0F, -1};

/// The depth map that the votes say.
DepthMap depth_map_from_votes(const Grid<PixelVote>& votes, const DepthPlanes& planes);

}  // namespace quorum
