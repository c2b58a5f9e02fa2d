#include "host/memory_pool.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace quorum {

std::uint64_t MemoryPool::size_class(std::uint64_t bytes) {
  constexpr std::uint64_t kLeast = 1024;
  constexpr std::uint64_t kLarge = 4 << 20;
  constexpr std::uint64_t kStepsOfDoubling = 8;
  if (bytes <= kLarge) return std::bit_ceil(std::max(bytes, kLeast));
  const std::uint64_t step = std::bit_floor(bytes) / kStepsOfDoubling;
  return (bytes + step - 1) / step * step;
}

std::optional<Allocation> MemoryPool::take(std::uint64_t bytes) {
  const std::scoped_lock lock(mutex_);
  const auto found = free_.find(bytes);
  if (found == free_.end()) return std::nullopt;
  held_ -= bytes;
  return std::move(free_.extract(found).mapped());
}

void MemoryPool::give(Allocation allocation) {
  const std::scoped_lock lock(mutex_);
  const std::uint64_t bytes = allocation.bytes;
  if (bytes == 0 || bytes > limit_) return;
  while (held_ > limit_ - bytes) {
    held_ -= free_.begin()->first;
    free_.erase(free_.begin());
  }
  held_ += bytes;
  free_.emplace(bytes, std::move(allocation));
}

bool MemoryPool::clear() {
  const std::scoped_lock lock(mutex_);
  held_ = 0;
  return !std::exchange(free_, {}).empty();
}

}  // namespace quorum
