#include "tests/parity/sweep_parity.h"

namespace quorum {
namespace {

class SweepDepthParity : public SweepParity {};

TEST_F(SweepDepthParity, EveryWindowAndModelGivesTheBytesOfTheTwin) {
  for (const WindowCase& input : window_cases()) {
    compare(input, SweepForm::kGroups, {16, 16}, Pass::kFirst, kAll);
    if (HasFailure()) return;
  }
}

TEST_F(SweepDepthParity, TheSecondPassGivesTheBytesOfTheTwin) {
  for (const WindowCase& input : window_cases()) {
    if (input.model == WindowModel::kAxis && input.flip) continue;  // finds almost nothing to refine
    compare(input, SweepForm::kGroups, {8, 8}, Pass::kSecond, kAll);
    if (HasFailure()) return;
  }
}

TEST_F(SweepDepthParity, BlocksAndBatchesDoNotMatter) {
  const WindowCase input{5, WindowModel::kPlane, true, 67, 45, 21};
  for (const BlockSize block : {BlockSize{16, 16}, BlockSize{8, 8}}) {
    compare(input, SweepForm::kGroups, block, Pass::kFirst, 1997);
    compare(input, SweepForm::kGroups, block, Pass::kSecond, 2003);
  }
}

}  // namespace
}  // namespace quorum
