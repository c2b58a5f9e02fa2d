#include "engine/io/view_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "engine/core/printable.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

constexpr std::size_t kLongest = 100;    // bytes of a name; files of a view append 20
constexpr std::size_t kNumberBytes = 8;  // of them for a number
constexpr std::size_t kLevels = 3;

bool is_separator(char c) { return c == '/' || c == '\\'; }

/// The parts of a path of any system, without those that only lead around.
std::vector<std::string> parts_of(std::string_view path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (is_separator(c))
      parts.emplace_back();
    else
      parts.back() += c;
  }
  const bool has_drive = parts[0].size() == 2 && parts[0][1] == ':';
  if (has_drive) parts[0].clear();
  std::erase_if(parts, [](const std::string& part) { return part.empty() || part == "." || part == ".."; });
  return parts;
}

bool leaves_its_folder(std::string_view path) {
  std::string slashed(1, '/');
  slashed.append(path).push_back('/');
  return path.empty() || is_separator(path[0]) || path.substr(0, 2).ends_with(':') || slashed.contains("/../") ||
         path.contains("..\\");
}

/// A name that is a good file's, whatever the text: its end where it is too long, since that tells names apart.
std::string file_name(std::string text) {
  text = printable(text, '_');
  if (text.size() > kLongest - kNumberBytes) {
    std::size_t begin = text.size() - (kLongest - kNumberBytes);
    while (begin < text.size() && (static_cast<unsigned char>(text[begin]) & 0xc0U) == 0x80) ++begin;
    text.erase(0, begin);
  }
  text.erase(0, std::min(text.find_first_not_of(". "), text.size()));
  return text.empty() ? "view" : text;
}

/// What a view may be called, from short to long.
std::array<std::string, kLevels> names_for(const std::string& image_name) {
  std::vector<std::string> parts = parts_of(image_name);
  if (parts.empty()) parts.emplace_back("view");
  const auto joined = [&parts] { return fmt::format("{}", fmt::join(parts, "_")); };
  const std::string whole = joined();
  parts.back() = std::filesystem::path(parts.back()).replace_extension().string();
  const std::string stem = joined();
  return {file_name(leaves_its_folder(image_name) ? parts.back() : stem), file_name(stem), file_name(whole)};
}

}  // namespace

std::string folded(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(c < 0x80 ? std::tolower(c) : c); });
  return text;
}

bool is_plain_path(const std::string& image_name) {
  if (leaves_its_folder(image_name) || image_name.contains('\\') || image_name.size() > 2 * kLongest) return false;
  if (printable(image_name) != image_name) return false;
  const std::vector<std::string> parts = parts_of(image_name);
  return fmt::format("{}", fmt::join(parts, "/")) == image_name && std::ranges::all_of(parts, [](const auto& part) {
           return part.size() <= kLongest && !part.starts_with('.') && !part.starts_with(' ');
         });
}

Expected<void> name_views(std::vector<View>& views) {
  std::set<std::string> labels;
  std::vector<std::array<std::string, kLevels>> names;
  for (View& view : views) {
    if (!labels.insert(view.image_name).second)
      return failure(ErrorKind::kInput,
                     fmt::format("image {} comes twice; remove one of the two", quote_token(view.image_name)));
    names.push_back(names_for(view.image_name));
    view.name = names.back()[0];
  }
  for (std::size_t level = 1; level < kLevels; ++level) {
    std::map<std::string, int> uses;
    for (const View& view : views) ++uses[folded(view.name)];
    for (std::size_t i = 0; i < views.size(); ++i)
      if (uses[folded(views[i].name)] > 1) views[i].name = names[i][level];
  }
  std::set<std::string> owned;  // before any gets a number
  for (const View& view : views) owned.insert(folded(view.name));
  std::set<std::string> taken;
  for (View& view : views) {
    const std::string name = view.name;
    const auto is_free = [&] {
      return !taken.contains(folded(view.name)) && (view.name == name || !owned.contains(folded(view.name)));
    };
    for (int number = 2; !is_free(); ++number) view.name = fmt::format("{}_{}", name, number);
    taken.insert(folded(view.name));
  }
  return {};
}

}  // namespace quorum
