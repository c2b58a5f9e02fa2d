#include "engine/depth/propose_planes.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace quorum {
namespace {

template <typename T>
using RowLanes = std::array<T, PlaneProposals::kCapacity>;

/// The planes of a row's pixels.
struct PlaneLanes {
  RowLanes<float> inverse_depth;
  RowLanes<float> slope_x;
  RowLanes<float> slope_y;
  RowLanes<std::int32_t> taken_by;

  /// Those of pixels (x + begin, y) to (x + end, y).
  void copy(const PlaneGrid& planes, int x, int y, int begin, int end) {
    const auto take = [&](const auto& from, auto& to) {
      std::copy_n(from.row(y) + (x + begin), end - begin, to.begin() + begin);
    };
    take(planes.inverse_depth, inverse_depth);
    take(planes.slope_x, slope_x);
    take(planes.slope_y, slope_y);
    take(planes.taken_by, taken_by);
  }
  [[gnu::always_inline]] PixelPlane at(std::size_t i) const {
    return {inverse_depth[i], slope_x[i], slope_y[i], 0.0F, 0.0F, taken_by[i]};
  }
};

/// All that a row needs, in one place: else the compiler finds too many arrays that might overlap, and gives up
/// vectors.
struct ProposeWorkspace {
  PlaneLanes own;
  PlaneLanes other;
  RowLanes<float> farthest;
  RowLanes<float> nearest;
  PlaneProposals proposals;
};

/// kFromNeighbor: whether the move has an offset, which the compiler must know, too.
template <bool kFromNeighbor>
[[gnu::always_inline]] inline void propose_body(const PlaneMove& move, float max_tilt, int count,
                                                ProposeWorkspace& work) {
  PlaneMove of_all = move;
  if (!kFromNeighbor) of_all.offset_x = of_all.offset_y = 0;
  if (kFromNeighbor && of_all.offset_x == 0 && of_all.offset_y == 0) __builtin_unreachable();
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const PlaneTrial trial = move_plane(of_all, work.own.at(i), work.other.at(i));
    work.proposals.inverse_depth[i] = trial.inverse_depth;
    work.proposals.slope_x[i] = trial.slope_x;
    work.proposals.slope_y[i] = trial.slope_y;
    const bool takes = may_take(trial, {work.farthest[i], work.nearest[i]}, max_tilt);
    work.proposals.may_take[i] = static_cast<std::int32_t>((trial.inverse_depth != 0.0F) & takes);
  }
}

}  // namespace

const PlaneProposals& propose_planes(const PlaneMove& move, const PlaneGrid& last, const PlaneGrid& best,
                                     const Grid<InverseDepthRange>& ranges, float max_tilt, int x, int y, int count,
                                     SimdLevel simd) {
  thread_local const auto work = std::make_unique<ProposeWorkspace>();
  const bool from_neighbor = move.offset_x != 0 || move.offset_y != 0;
  const int other_x = x + move.offset_x;
  const int other_y = y + move.offset_y;
  if (from_neighbor) {
    const int begin = std::max(0, -other_x);
    const int end = std::min(count, ranges.width - other_x);
    if (other_y < 0 || other_y >= ranges.height || begin >= end) {
      std::fill_n(work->proposals.may_take.begin(), count, 0);
      return work->proposals;
    }
    if (begin > 0 || end < count) work->other.inverse_depth.fill(0.0F);  // no plane beyond the border
    work->other.copy(last, other_x, other_y, begin, end);
  }
  work->own.copy(best, x, y, 0, count);
  for (int i = 0; i < count; ++i) {
    const InverseDepthRange& range = ranges.at(x + i, y);
    work->farthest[static_cast<std::size_t>(i)] = range.farthest;
    work->nearest[static_cast<std::size_t>(i)] = range.nearest;
  }
  (from_neighbor ? simd_form<propose_body<true>>(simd) : simd_form<propose_body<false>>(simd))(move, max_tilt, count,
                                                                                               *work);
  return work->proposals;
}

}  // namespace quorum
