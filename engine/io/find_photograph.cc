#include "engine/io/find_photograph.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "engine/io/file.h"

namespace quorum {
namespace {

namespace fs = std::filesystem;

/// The file, or the one with a like extension.
fs::path with_like_extension(const fs::path& path) {
  if (is_file(path)) return path;
  std::string extension = path.extension().string();
  for (int (*change)(int) : {&::tolower, &::toupper}) {
    std::ranges::transform(extension, extension.begin(),
                           [change](unsigned char c) { return static_cast<char>(change(c)); });
    if (fs::path other = fs::path(path).replace_extension(extension); !extension.empty() && is_file(other))
      return other;
  }
  if (extension.size() == 4 || extension.size() == 5) return {};  // no a.jpg.png for a.jpg: that is its mask
  for (const char* usual :
       {".png", ".jpg", ".JPG", ".jpeg", ".JPEG", ".PNG", ".tif", ".tiff", ".TIF", ".webp", ".heic", ".HEIC", ".avif"})
    if (fs::path other = path.string() + usual; is_file(other)) return other;
  return {};
}

/// The end of a path below the folder, the longest one first.
fs::path by_end(const fs::path& folder, const fs::path& path) {
  for (auto part = path.begin(); part != path.end(); ++part) {
    fs::path end;
    for (auto at = part; at != path.end(); ++at) end /= *at;
    if (end.is_absolute() || end.empty()) continue;
    if (fs::path found = with_like_extension(folder / end); !found.empty()) return found;
  }
  return {};
}

/// As a scene says the name, but for escapes.
fs::path find_as_said(const fs::path& folder, const std::string& name) {
  if (fs::path found = with_like_extension(folder / name); !found.empty()) return found;
  std::string slashed = name;
  std::ranges::replace(slashed, '\\', '/');
  const bool has_drive = slashed.size() > 2 && slashed[1] == ':' && slashed[2] == '/';
  if (has_drive || slashed.starts_with('/')) return by_end(folder, slashed);
  return slashed != name ? with_like_extension(folder / slashed) : fs::path();
}

/// The path that a URI stands for; the name itself if it is none, or an escape stands for a control character.
std::string without_escapes(const std::string& name) {
  constexpr std::string_view kScheme = "file:";
  std::string path;
  for (std::size_t at = name.starts_with("file:/") ? kScheme.size() : 0; at < name.size(); ++at) {
    auto byte = static_cast<unsigned char>(name[at]);
    if (byte == '%' && at + 2 < name.size()) {
      const char* const end = name.data() + at + 3;
      if (const auto [stop, error] = std::from_chars(name.data() + at + 1, end, byte, 16);
          error == std::errc() && stop == end) {
        if (byte < 0x20 || byte == 0x7f) return name;
        at += 2;
      }
    }
    path += static_cast<char>(byte);
  }
  return path;
}

}  // namespace

fs::path find_photograph(const fs::path& folder, const std::string& name) {
  if (name.empty()) return {};
  if (fs::path found = find_as_said(folder, name); !found.empty()) return found;
  const std::string path = without_escapes(name);
  return path != name && !path.empty() ? find_as_said(folder, path) : fs::path();
}

fs::path find_photograph_by_end(const fs::path& folder, const std::string& name) {
  if (fs::path found = find_photograph(folder, name); !found.empty()) return found;
  for (std::string path : {name, without_escapes(name)}) {
    std::ranges::replace(path, '\\', '/');
    if (fs::path found = by_end(folder, fs::path(path).lexically_normal()); !found.empty()) return found;
  }
  return {};
}

}  // namespace quorum
