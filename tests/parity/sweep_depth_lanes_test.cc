#include "tests/parity/sweep_parity.h"

namespace quorum {
namespace {

class SweepDepthLanesParity : public SweepParity {};

TEST_F(SweepDepthLanesParity, EveryWindowGivesTheBytesOfTheTwin) {
  for (const WindowCase& input : window_cases()) {
    if (input.model == WindowModel::kAxis) continue;
    compare(input, SweepForm::kLanes, {8, 8}, Pass::kFirst, kAll);
    if (HasFailure()) return;
  }
}

TEST_F(SweepDepthLanesParity, TheSecondPassGivesTheBytesOfTheTwin) {
  for (const WindowCase& input : window_cases()) {
    if (input.model == WindowModel::kAxis) continue;
    compare(input, SweepForm::kLanes, {4, 4}, Pass::kSecond, kAll);
    if (HasFailure()) return;
  }
}

TEST_F(SweepDepthLanesParity, BlocksAndBatchesDoNotMatter) {
  const WindowCase input{5, WindowModel::kPlane, true, 67, 45, 21};
  for (const BlockSize block : {BlockSize{8, 8}, BlockSize{4, 4}, BlockSize{4, 2}}) {
    compare(input, SweepForm::kLanes, block, Pass::kFirst, 1997);
    compare(input, SweepForm::kLanes, block, Pass::kSecond, 2003);
  }
}

}  // namespace
}  // namespace quorum
