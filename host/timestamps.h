// How long the regions of a command buffer took, by the clock of the device. For the files of this layer alone.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/commands.h"
#include "host/state.h"

namespace quorum {

/// One timestamp at each border of two regions, read when the submission is done. A queue without timestamps gives no
/// timings.
class Timestamps {
 public:
  /// Throws vk::SystemError.
  explicit Timestamps(const Device::State& device);

  /// Starts the timestamps of a command buffer.
  void begin(const vk::raii::CommandBuffer& commands);
  /// Whether the command buffer has room for no other region.
  [[nodiscard]] bool full() const { return regions_.size() == kMaxRegions; }
  /// Ends the region before, if any, and starts one. At most kMaxRegions in a command buffer.
  void start_region(const vk::raii::CommandBuffer& commands, std::string_view name);
  /// Ends the last region.
  void end(const vk::raii::CommandBuffer& commands);
  /// Adds what was measured to timings, once the device is done. Returns the seconds from the first region's start to
  /// the last one's end. Throws vk::SystemError.
  double collect(std::vector<RegionTiming>& timings) const;

  static constexpr std::uint32_t kMaxRegions = 1023;

 private:
  void write(const vk::raii::CommandBuffer& commands);

  std::uint64_t valid_bits_ = 0;  ///< a mask
  double seconds_per_tick_ = 0.0;
  vk::raii::QueryPool pool_ = nullptr;
  std::uint32_t count_ = 0;  ///< timestamps written in this command buffer
  std::vector<std::string> regions_;
};

}  // namespace quorum
