// How much work one submission holds: drivers kill long ones, so they stay near a tenth of a second.
#pragma once

#include <algorithm>
#include <cstdint>

namespace quorum {

/// A number of work items per submission that follows what the device was measured to manage. Results do not depend on
/// it.
class BatchSize {
 public:
  static constexpr double kTargetSeconds = 0.08;

  /// least, most: bounds of the number, from memory and from what a dispatch needs to be worth its while.
  BatchSize(std::int64_t start, std::int64_t least, std::int64_t most)
      : least_(least), most_(std::max(least, most)), items_(std::clamp(start, least_, most_)) {}

  [[nodiscard]] std::int64_t items() const { return items_; }

  /// After a submission of done items that took seconds: aims at kTargetSeconds, growing at most twofold at a time.
  void measured(std::int64_t done, double seconds) {
    if (done <= 0 || seconds <= 0.0) return;
    const double wanted = static_cast<double>(done) * kTargetSeconds / seconds;
    const double limited = std::min(wanted, 2.0 * static_cast<double>(items_));
    items_ = std::clamp(static_cast<std::int64_t>(limited), least_, most_);
  }

 private:
  std::int64_t least_;
  std::int64_t most_;
  std::int64_t items_;
};

}  // namespace quorum
