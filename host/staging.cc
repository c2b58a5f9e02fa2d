#include "host/staging.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <cstring>

#include "engine/core/check.h"

namespace quorum {
namespace {

/// On as many threads as it is worth.
void copy_bytes(const std::byte* from, std::byte* to, std::size_t size) {
  constexpr std::size_t kGrain = 1U << 20;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, kGrain),
                    [&](const auto& part) { std::memcpy(to + part.begin(), from + part.begin(), part.size()); });
}

}  // namespace

Expected<void> Staging::open() {
  if (*allocation_.buffer) return {};
  return guarded("allocating a staging buffer", [&] { allocation_ = device_->allocate_staging(); });
}

std::uint64_t Staging::put(std::span<const std::byte> bytes) {
  QUORUM_CHECK_LE(bytes.size(), room());
  const std::uint64_t place = used_;
  copy_bytes(bytes.data(), allocation_.mapped + place, bytes.size());
  used_ += bytes.size();
  return place;
}

void Staging::get(std::span<std::byte> bytes) const {
  QUORUM_CHECK_LE(bytes.size(), kStagingBytes);
  copy_bytes(allocation_.mapped, bytes.data(), bytes.size());
}

}  // namespace quorum
