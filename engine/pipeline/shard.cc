#include "engine/pipeline/shard.h"

#include <fmt/format.h>

#include "engine/core/parse_number.h"

namespace quorum {

std::string Shard::text() const { return fmt::format("{}/{}", index + 1, count); }

std::optional<Shard> parse_shard(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = parse_number<int>(text.substr(0, slash));
  const auto count = parse_number<int>(text.substr(slash + 1));
  if (!number || !count || *number < 1 || *number > *count || *count > kMostShards) return std::nullopt;
  return Shard{*number - 1, *count};
}

}  // namespace quorum
