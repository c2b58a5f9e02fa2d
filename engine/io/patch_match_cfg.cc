#include "engine/io/patch_match_cfg.h"

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

Expected<int> read_patch_match_cfg(const std::filesystem::path& path, std::vector<View>& views) {
  QUORUM_ASSIGN(const auto text, read_file(path));
  std::map<std::string, int, std::less<>> view_of;
  for (std::size_t i = 0; i < views.size(); ++i) view_of.emplace(views[i].image_name, static_cast<int>(i));
  LineReader lines(text);
  int unknown = 0;
  const auto find = [&](std::string_view name) {
    const auto place = view_of.find(name);
    if (place == view_of.end()) ++unknown;
    return place != view_of.end() ? place->second : -1;
  };
  while (const auto name = next_entry(lines)) {
    const int reference = find(*name);
    const auto sources = next_entry(lines);
    if (!sources) break;  // as COLMAP reads it
    std::vector<int> neighbors;
    if (*sources == "__all__") {
      for (int view = 0; view < static_cast<int>(views.size()); ++view)
        if (view != reference) neighbors.push_back(view);
    } else if (!sources->starts_with("__auto__")) {
      for (std::size_t begin = 0; begin <= sources->size();) {
        const std::size_t end = std::min(sources->find(',', begin), sources->size());
        const int source = find(trimmed(sources->substr(begin, end - begin)));
        if (source >= 0 && source != reference && std::ranges::count(neighbors, source) == 0)
          neighbors.push_back(source);
        begin = end + 1;
      }
    }
    if (reference >= 0) views[static_cast<std::size_t>(reference)].neighbors = std::move(neighbors);
  }
  return unknown;
}

}  // namespace quorum
