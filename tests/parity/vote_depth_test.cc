#include "tests/parity/vote_parity.h"

namespace quorum {
namespace {

class VoteDepthParity : public VoteParity {};

TEST_F(VoteDepthParity, SeededVotesGiveTheBytesOfTheTwin) { compare_all("vote_depth"); }

}  // namespace
}  // namespace quorum
