// A part of a stage's work, for runs that several processes, perhaps on several machines, share.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace quorum {

/// The index-th of count parts. Which work that is depends on these two numbers alone.
struct Shard {
  int index = 0;  ///< 0 to count - 1; as text it counts from 1: "3/7"
  int count = 1;  ///< 1 to kMostShards

  /// Whether an item of a list, such as a view, is worked on: every count-th is.
  [[nodiscard]] bool has(int item) const { return item % count == index; }
  /// The first and the end of a run of items, of so many; runs of all shards follow each other.
  [[nodiscard]] std::pair<std::size_t, std::size_t> range(std::size_t items) const {
    const auto begin = [&](int i) { return items * static_cast<std::size_t>(i) / static_cast<std::size_t>(count); };
    return {begin(index), begin(index + 1)};
  }
  [[nodiscard]] std::string text() const;
  bool operator==(const Shard&) const = default;
};

constexpr int kMostShards = 10'000;

/// "1/7" to "7/7"; empty if it is none.
std::optional<Shard> parse_shard(std::string_view text);

}  // namespace quorum
