#include "engine/core/host_rates.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "engine/core/clock.h"
#include "engine/core/simd.h"

namespace quorum {
namespace {

constexpr int kLanes = 128;       // independent chains: enough vectors to hide a multiplication's latency
constexpr int kRounds = 1 << 18;  // some milliseconds
constexpr int kRepeats = 5;       // the best counts: what else the machine does only slows down

/// kLanes · kRounds multiplications and as many additions.
[[gnu::always_inline]] inline void multiply_and_add(std::uint32_t* values) {
  std::uint32_t lane[kLanes];
  std::copy_n(values, kLanes, lane);
  const std::uint32_t factor = values[0] | 1U;
  for (int round = 0; round < kRounds; ++round)
    for (int i = 0; i < kLanes; ++i) lane[i] = lane[i] * factor + 12345U;
  std::copy_n(lane, kLanes, values);
}

/// Shortest time of a few runs of work(thread) on all threads at once.
template <typename Work>
double best_seconds(int threads, const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const double start = wall_seconds();
    tbb::parallel_for(0, threads, work, tbb::simple_partitioner());
    best = std::min(best, wall_seconds() - start);
  }
  return best;
}

}  // namespace

HostRates measure_host_rates() {
  constexpr std::size_t kBytes = 64 << 20;  // per thread, each of source and target
  HostRates rates;
  rates.threads = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  const auto threads = static_cast<std::size_t>(rates.threads);

  std::vector<std::uint32_t> values(threads * kLanes, 3U);
  const auto compute = simd_form<multiply_and_add>(best_simd_level());
  const double arithmetic = best_seconds(
      rates.threads, [&](int thread) { compute(values.data() + static_cast<std::size_t>(thread) * kLanes); });
  rates.operations_per_second = 2.0 * kLanes * kRounds * rates.threads / arithmetic;

  std::vector<std::vector<char>> source(threads, std::vector<char>(kBytes, 1));
  std::vector<std::vector<char>> target(threads, std::vector<char>(kBytes));
  const double copy = best_seconds(rates.threads, [&](int thread) {
    const auto index = static_cast<std::size_t>(thread);
    std::memcpy(target[index].data(), source[index].data(), kBytes);
  });
  rates.bytes_per_second = 2.0 * kBytes * rates.threads / copy;
  return rates;
}

}  // namespace quorum
