#include "host/timestamps.h"

#include <algorithm>

#include "engine/core/check.h"

namespace quorum {

Timestamps::Timestamps(const Device::State& device)
    : seconds_per_tick_(static_cast<double>(device.limits.timestampPeriod) * 1e-9) {
  if (device.timestamp_bits == 0) return;
  valid_bits_ = ~std::uint64_t{0} >> (64U - device.timestamp_bits);
  pool_ = {device.device,
           vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = kMaxRegions + 1}};
}

void Timestamps::begin(const vk::raii::CommandBuffer& commands) {
  count_ = 0;
  regions_.clear();
  if (valid_bits_ != 0) commands.resetQueryPool(*pool_, 0, kMaxRegions + 1);
}

void Timestamps::start_region(const vk::raii::CommandBuffer& commands, std::string_view name) {
  QUORUM_CHECK_LT(regions_.size(), kMaxRegions);
  regions_.emplace_back(name);
  write(commands);
}

void Timestamps::end(const vk::raii::CommandBuffer& commands) {
  if (!regions_.empty()) write(commands);
}

double Timestamps::collect(std::vector<RegionTiming>& timings) const {
  if (valid_bits_ == 0 || count_ < 2) return 0.0;
  const auto [result, ticks] =
      pool_.getResults<std::uint64_t>(0, count_, count_ * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                      vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  const auto seconds_between = [&](std::size_t from, std::size_t to) {
    return static_cast<double>((ticks[to] - ticks[from]) & valid_bits_) * seconds_per_tick_;
  };
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    auto timing = std::ranges::find(timings, regions_[i], &RegionTiming::name);
    if (timing == timings.end()) timing = timings.insert(timings.end(), RegionTiming{.name = regions_[i]});
    timing->seconds += seconds_between(i, i + 1);
    ++timing->count;
  }
  return seconds_between(0, regions_.size());
}

void Timestamps::write(const vk::raii::CommandBuffer& commands) {
  if (valid_bits_ != 0) commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *pool_, count_);
  ++count_;
}

}  // namespace quorum
