// How much memory a run may hold, and what is left of it.
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/core/error.h"

namespace quorum {

/// The budget counts everything that the process holds: what a stage takes is measured against what the process held
/// when it was asked for. So a stage that knows what it takes at most keeps the budget whatever came before.
class MemoryBudget {
 public:
  /// bytes: 0 = automatic, three quarters of what the machine has left and what the process holds already.
  explicit MemoryBudget(std::uint64_t bytes);

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// What stages may still take, less a little for code and stacks that come into use. 0 if nothing is left.
  [[nodiscard]] std::uint64_t left() const;
  /// Fails (kMemory) if `more` bytes don't fit; the message says what for, and the least budget that would do, for the
  /// rest of the run, too, as far as it is known.
  [[nodiscard]] Expected<void> require(std::uint64_t more, std::string_view what_for) const;
  /// That the run will need this at least, beside what the process holds now.
  void foresee(std::uint64_t bytes);

 private:
  std::uint64_t bytes_;
  std::uint64_t foreseen_ = 0;  // in all
};

}  // namespace quorum
