#include "tests/parity/vote_parity.h"

namespace quorum {
namespace {

class VoteDepthLanesParity : public VoteParity {};

TEST_F(VoteDepthLanesParity, SeededVotesGiveTheBytesOfTheTwin) { compare_all("vote_depth_lanes"); }

}  // namespace
}  // namespace quorum
