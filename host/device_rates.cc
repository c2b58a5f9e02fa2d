#include "host/device_rates.h"

#include <algorithm>
#include <limits>

#include "host/commands.h"

namespace quorum {
namespace {

constexpr int kRepeats = 3;              // the best counts: what else the device does only slows down
constexpr double kLongEnough = 0.02;     // seconds: far above what a submission takes, far below what drivers kill
constexpr std::uint32_t kRounds = 1024;  // of measure_operations
constexpr double kRoundOperations = 32;  // of an invocation
constexpr std::uint64_t kCopyBytes = 64 << 20;

/// Shortest of a few submissions of what record records.
template <typename Record>
Expected<double> best_seconds(Commands& commands, const Record& record) {
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    record();
    QUORUM_TRY(commands.submit());
    best = std::min(best, commands.last_submission_seconds());
  }
  return best;
}

/// Takes more and more invocations until they fill the device for long enough.
Expected<double> operations_per_second(Commands& commands) {
  constexpr std::int64_t kMaxInvocations = 1 << 22;
  const Kernel kernel = commands.kernel("measure_operations");
  const Buffer values = commands.allocate_zeros(kMaxInvocations * sizeof(std::uint32_t));
  for (std::int64_t invocations = 1 << 12;; invocations *= 4) {
    QUORUM_ASSIGN(const double seconds,
                  best_seconds(commands, [&] { commands.dispatch(kernel, {invocations}, kRounds, {values}); }));
    if (seconds >= kLongEnough || invocations == kMaxInvocations)
      return kRoundOperations * kRounds * static_cast<double>(invocations) / seconds;
  }
}

Expected<double> bytes_per_second(Commands& commands) {
  const std::uint64_t size = std::min(kCopyBytes, commands.device().info().max_storage_buffer_range);
  const Buffer source = commands.allocate_zeros(size);
  const Buffer target = commands.allocate(size);
  QUORUM_ASSIGN(const double seconds, best_seconds(commands, [&] { commands.copy(source, target); }));
  return 2.0 * static_cast<double>(size) / seconds;
}

}  // namespace

Expected<DeviceRates> measure_device_rates(const Device& device) {
  QUORUM_ASSIGN(auto commands, Commands::create(device));
  QUORUM_ASSIGN(const auto operations, operations_per_second(commands));
  QUORUM_ASSIGN(const auto bytes, bytes_per_second(commands));
  return DeviceRates{operations, bytes};
}

}  // namespace quorum
