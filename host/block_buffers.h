// What a device keeps of blocks (their voxels, or a bit for each of these), cut into buffers of which none exceeds what
// a kernel can see.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <new>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "host/commands.h"

namespace quorum {

class BlockBuffers {
 public:
  /// Holds this many blocks, all bytes 0, in place of those before. what: in words, for messages.
  /// Fails (kDevice, kMemory) if the device does.
  Expected<void> reset(Commands& commands, std::size_t count, std::size_t block_bytes, std::string_view what) {
    *this = {};
    count_ = count;
    block_bytes_ = block_bytes;
    const DeviceInfo& info = commands.device().info();
    per_buffer_ = std::max<std::size_t>(1, std::min(info.max_storage_buffer_range, info.max_allocation) / block_bytes);
    for (std::size_t first = 0; first < count; first += per_buffer_) {
      buffers_.push_back(commands.allocate_zeros(std::min(per_buffer_, count - first) * block_bytes));
      const auto made = commands.submit();
      if (!made) return std::unexpected(made.error().within(what));
    }
    return {};
  }

  /// Entries of a list whose blocks lie in one buffer, and where it begins.
  template <typename Entry>
  struct Part {
    std::span<const Entry> entries;
    const Buffer& buffer;
    int first_block;
  };
  /// The first entries of a list that is not empty and ascends by place, most at the most. place: of an entry, the
  /// number of its block.
  template <typename Entry, typename Place = std::identity>
  [[nodiscard]] Part<Entry> first_part(std::span<const Entry> list, std::size_t most, Place place = {}) const {
    const std::size_t buffer = std::invoke(place, list.front()) / per_buffer_;
    const auto some = list.first(std::min(most, list.size()));
    const auto end = std::ranges::lower_bound(some, (buffer + 1) * per_buffer_, {}, place);
    return {some.first(static_cast<std::size_t>(end - some.begin())), buffers_[buffer],
            static_cast<int>(buffer * per_buffer_)};
  }

  /// All blocks, of one T or of several; holds none after that. Fails (kMemory) if they do not fit the host's memory;
  /// (kDevice, kMemory) if the device does.
  template <typename T>
  Expected<std::vector<T>> take(Commands& commands, std::string_view what) {
    std::vector<T> values;
    try {
      values.resize(count_ * (block_bytes_ / sizeof(T)));
    } catch (const std::bad_alloc&) {
      return failure(ErrorKind::kMemory, fmt::format("reading {} back needs {} MiB; give a larger --voxel-size", what,
                                                     count_ * block_bytes_ >> 20));
    }
    std::span<T> rest = values;
    for (const Buffer& buffer : std::exchange(buffers_, {})) {
      const std::size_t size = buffer.size() / sizeof(T);
      QUORUM_TRY(commands.download(buffer, rest.first(size)));
      rest = rest.subspan(size);
    }
    return values;
  }

 private:
  std::size_t count_ = 0;
  std::size_t block_bytes_ = 1;
  std::size_t per_buffer_ = 1;
  std::vector<Buffer> buffers_;  ///< per_buffer_ blocks each
};

}  // namespace quorum
