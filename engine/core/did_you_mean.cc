#include "engine/core/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>

namespace quorum {
namespace {

/// Edits (a letter more, less, another, or two in the other order) that lead from one word to the other.
std::size_t edits_between(std::string_view from, std::string_view to) {
  std::vector<std::vector<std::size_t>> edits(from.size() + 1, std::vector<std::size_t>(to.size() + 1));
  for (std::size_t i = 0; i <= from.size(); ++i)
    for (std::size_t j = 0; j <= to.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      const bool same = from[i - 1] == to[j - 1];
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, edits[i - 1][j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  return edits[from.size()][to.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 64;
  if (word.size() > kLongest) return "";
  std::size_t least = 1 + std::max<std::size_t>(1, word.size() / 4);
  std::string nearest;
  for (const std::string& name : names)
    if (const std::size_t edits = edits_between(word, name); edits < least) {
      least = edits;
      nearest = name;
    }
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

}  // namespace quorum
