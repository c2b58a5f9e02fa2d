#include "engine/pipeline/parse_bounds.h"

#include <fmt/format.h>

#include <charconv>

#include "engine/core/option.h"

namespace quorum {

Expected<Bounds> parse_bounds(std::string_view name, const std::vector<std::string>& words) {
  std::vector<double> numbers;
  for (const std::string& word : words) {
    const char* at = word.data();
    const char* const end = at + word.size();
    while (at < end) {
      if (*at == ' ' || *at == ',') {
        ++at;
        continue;
      }
      const auto [next, problem] = std::from_chars(at, end, numbers.emplace_back());
      if (problem != std::errc())
        return failure(ErrorKind::kUsage,
                       fmt::format("{} {}: not a number; give x0 y0 z0 x1 y1 z1", option_name(name), word));
      at = next;
    }
  }
  if (numbers.size() != 6)
    return failure(ErrorKind::kUsage, fmt::format("{}: expected six numbers x0 y0 z0 x1 y1 z1, found {}",
                                                  option_name(name), numbers.size()));
  return Bounds{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
}

}  // namespace quorum
