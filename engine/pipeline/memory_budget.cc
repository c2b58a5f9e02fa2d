#include "engine/pipeline/memory_budget.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/memory.h"
#include "engine/core/option.h"

namespace quorum {
namespace {

constexpr std::uint64_t kStep = 8 << 20;  // the process does not hold the same to the byte in every run

}  // namespace

MemoryBudget::MemoryBudget(std::uint64_t bytes) : bytes_(bytes) {
  if (bytes_ == 0)
    bytes_ = resident_bytes() + available_bytes() / 4 * 3;
  else
    return_large_blocks_at_once();
}

std::uint64_t MemoryBudget::left() const {
  return_freed_memory();
  const std::uint64_t held = resident_bytes() + kStep;
  return bytes_ > held ? bytes_ - held : 0;
}

Expected<void> MemoryBudget::require(std::uint64_t more, std::string_view what_for) const {
  if (more <= left()) return {};
  const std::uint64_t least =
      (std::max(resident_bytes() + more + more / 16, foreseen_) + 3 * kStep - 1) / kStep * kStep;
  return failure(ErrorKind::kMemory,
                 fmt::format("{} needs {} MiB of memory at least, more than the budget of {} MiB; "
                             "give {} {}MiB",
                             what_for, least >> 20, bytes_ >> 20, option_name("memory"), least >> 20));
}

void MemoryBudget::foresee(std::uint64_t bytes) {
  foreseen_ = std::max(foreseen_, resident_bytes() + bytes + bytes / 16);
}

}  // namespace quorum
