#include "host/device_rates.h"

#include <algorithm>
#include <limits>

#include "host/commands.h"
#include "host/kernel_table.h"

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
    if (auto done = commands.submit(); !done) return std::unexpected(done.error());
    best = std::min(best, commands.last_submission_seconds());
  }
  return best;
}

/// Takes more and more invocations until they fill the device for long enough.
Expected<double> operations_per_second(const Device& device, Commands& commands) {
  constexpr std::int64_t kMaxInvocations = 1 << 22;
  auto kernel = Kernel::create(device, find_kernel("measure_operations"));
  if (!kernel) return std::unexpected(kernel.error());
  auto values = Buffer::create(device, kMaxInvocations * sizeof(std::uint32_t));
  if (!values) return std::unexpected(values.error());
  if (auto filled = values->fill_zero(); !filled) return std::unexpected(filled.error());
  for (std::int64_t invocations = 1 << 12;; invocations *= 4) {
    const auto seconds = best_seconds(commands, [&] { commands.dispatch(*kernel, {invocations}, kRounds, {*values}); });
    if (!seconds) return seconds;
    if (*seconds >= kLongEnough || invocations == kMaxInvocations)
      return kRoundOperations * kRounds * static_cast<double>(invocations) / *seconds;
  }
}

Expected<double> bytes_per_second(const Device& device, Commands& commands) {
  const std::uint64_t size = std::min(kCopyBytes, device.info().max_storage_buffer_range);
  auto source = Buffer::create(device, size);
  if (!source) return std::unexpected(source.error());
  auto target = Buffer::create(device, size);
  if (!target) return std::unexpected(target.error());
  if (auto filled = source->fill_zero(); !filled) return std::unexpected(filled.error());
  const auto seconds = best_seconds(commands, [&] { commands.copy(*source, *target); });
  if (!seconds) return seconds;
  return 2.0 * static_cast<double>(size) / *seconds;
}

}  // namespace

Expected<DeviceRates> measure_device_rates(const Device& device) {
  auto commands = Commands::create(device);
  if (!commands) return std::unexpected(commands.error());
  const auto operations = operations_per_second(device, *commands);
  if (!operations) return std::unexpected(operations.error());
  const auto bytes = bytes_per_second(device, *commands);
  if (!bytes) return std::unexpected(bytes.error());
  return DeviceRates{*operations, *bytes};
}

}  // namespace quorum
