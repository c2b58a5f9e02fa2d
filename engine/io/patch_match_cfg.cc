#include "engine/io/patch_match_cfg.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "engine/io/file.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kTextSpace), text.size()));
  return text.substr(0, text.find_last_not_of(kTextSpace) + 1);
}

/// The next line that is neither blank nor a comment, without spaces around.
std::optional<std::string_view> next_entry(LineReader& lines) {
  auto line = lines.next_filled();
  while (line && trimmed(*line).starts_with('#')) line = lines.next_filled();
  if (!line) return std::nullopt;
  return trimmed(*line);
}

}  // namespace

Expected<void> read_patch_match_cfg(const std::filesystem::path& path, std::vector<View>& views) {
  const auto text = read_file(path);
  if (!text) return std::unexpected(text.error());
  std::map<std::string, int, std::less<>> view_of;
  for (std::size_t i = 0; i < views.size(); ++i) view_of.emplace(views[i].image_name, static_cast<int>(i));
  LineReader lines(*text);
  const auto find = [&](std::string_view name) -> Expected<int> {
    const auto place = view_of.find(name);
    if (place != view_of.end()) return place->second;
    return failure_at_line(path, lines.number(), fmt::format("the model has no image {}", quote_token(name)));
  };
  while (const auto name = next_entry(lines)) {
    const auto reference = find(*name);
    if (!reference) return std::unexpected(reference.error());
    const auto sources = next_entry(lines);
    if (!sources)
      return failure_at_line(path, lines.number(), fmt::format("no line with sources follows {}", quote_token(*name)));
    std::vector<int>& neighbors = views[static_cast<std::size_t>(*reference)].neighbors;
    neighbors.clear();
    if (sources->starts_with("__auto__")) continue;
    if (*sources == "__all__") {
      for (int view = 0; view < static_cast<int>(views.size()); ++view)
        if (view != *reference) neighbors.push_back(view);
      continue;
    }
    for (std::size_t begin = 0; begin <= sources->size();) {
      const std::size_t end = std::min(sources->find(',', begin), sources->size());
      const auto source = find(trimmed(sources->substr(begin, end - begin)));
      if (!source) return std::unexpected(source.error());
      if (*source != *reference && std::ranges::count(neighbors, *source) == 0) neighbors.push_back(*source);
      begin = end + 1;
    }
  }
  return {};
}

}  // namespace quorum
