// Device memory that buffers gave back, for buffers to come: drivers take far longer to allocate memory than a kernel
// takes to fill it. For the files of this layer alone.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>

#include "host/allocation.h"

namespace quorum {

class MemoryPool {
 public:
  /// Bytes that are allocated for a buffer of this many, so that buffers of about one size can take each other's
  /// place: a power of two up to 4 MiB, and at most an eighth more beyond.
  static std::uint64_t size_class(std::uint64_t bytes);

  /// Keeps at most this many bytes; 0 = nothing.
  void set_limit(std::uint64_t bytes) { limit_ = bytes; }

  /// Memory of exactly this size, if some was given back.
  std::optional<Allocation> take(std::uint64_t bytes);
  /// Keeps it, in place of the smallest if there is no room.
  void give(Allocation allocation);
  /// Frees what is kept. True if there was something.
  bool clear();

 private:
  std::mutex mutex_;
  std::multimap<std::uint64_t, Allocation> free_;
  std::uint64_t limit_ = 0;
  std::uint64_t held_ = 0;
};

}  // namespace quorum
