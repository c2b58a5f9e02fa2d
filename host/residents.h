// What stays on a device of what the host has, from view to view: photographs are neighbors of several views, depth
// maps confirm several.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "host/buffer.h"
#include "host/device.h"

namespace quorum {

/// A share of the device's memory for what stays there; 0 on a device that reads the host's memory, where a copy gains
/// nothing.
inline std::uint64_t resident_bytes(const Device& device, std::uint64_t one_in) {
  const bool shares_memory = device.maps_buffers() || device.info().kind == DeviceKind::kIntegrated;
  return shares_memory ? 0 : device.info().largest_device_heap / one_in;
}

/// Keeps objects as long as the host has them too; those used least recently are dropped first.
template <typename T>
class Residents {
 public:
  /// upload: makes the buffers of an object; all empty if it fails.
  Residents(std::uint64_t most_bytes, std::function<std::vector<Buffer>(const T&)> upload)
      : most_bytes_(most_bytes), upload_(std::move(upload)) {}

  /// The buffers of an object, made unless they are there.
  std::vector<Buffer> of(const std::shared_ptr<const T>& object) {
    drop_gone();  // first, since a new object may stand where one stood that is gone
    if (const auto there = entries_.find(object.get()); there != entries_.end()) {
      there->second.last_use = ++uses_;
      return there->second.buffers;
    }
    Entry entry{object, upload_(*object), 0, ++uses_};
    for (const Buffer& buffer : entry.buffers) entry.bytes += buffer.size();
    if (entry.bytes == 0 || entry.bytes > most_bytes_) return entry.buffers;
    while (bytes_ > most_bytes_ - entry.bytes) drop_least_recent();
    bytes_ += entry.bytes;
    return entries_.emplace(object.get(), std::move(entry)).first->second.buffers;
  }

  /// Drops all, as after a failure, when what was recorded has not run.
  void clear() {
    entries_.clear();
    bytes_ = 0;
  }

 private:
  struct Entry {
    std::weak_ptr<const T> object;
    std::vector<Buffer> buffers;
    std::uint64_t bytes = 0;
    std::uint64_t last_use = 0;
  };
  using Entries = std::map<const T*, Entry>;

  void drop_gone() {
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      const auto next = std::next(entry);
      if (entry->second.object.expired()) drop(entry);
      entry = next;
    }
  }
  void drop_least_recent() {
    drop(std::ranges::min_element(entries_, {}, [](const auto& entry) { return entry.second.last_use; }));
  }
  void drop(Entries::iterator place) {
    bytes_ -= place->second.bytes;
    entries_.erase(place);
  }

  std::uint64_t most_bytes_;
  std::function<std::vector<Buffer>(const T&)> upload_;
  Entries entries_;
  std::uint64_t bytes_ = 0;  ///< of the entries
  std::uint64_t uses_ = 0;
};

}  // namespace quorum
