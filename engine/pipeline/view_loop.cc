#include "engine/pipeline/view_loop.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdint>

namespace quorum {

ViewsInFlight views_in_flight(const Run& run, const MemoryEstimate& least, const MemoryEstimate& each_more) {
  constexpr std::uint64_t kMost = 6;
  const std::uint64_t spare = std::max(run.budget.left(), least.total()) - least.total();
  const std::uint64_t threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const std::size_t at_once = run.backend.views_at_once();
  const std::uint64_t wanted = std::clamp<std::uint64_t>(threads / 4, at_once, kMost);
  const std::uint64_t held = 1 + spare / 4 / std::max<std::uint64_t>(each_more.total(), 1);
  const auto count = static_cast<std::size_t>(std::min(wanted, held));
  return {count, std::min(count, at_once)};
}

}  // namespace quorum
