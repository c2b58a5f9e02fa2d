#include "engine/io/masks.h"

#include <fmt/format.h>

#include <map>
#include <string>

#include "engine/io/find_photograph.h"

namespace quorum {

Expected<void> find_masks(const std::filesystem::path& masks, std::vector<View>& views) {
  namespace fs = std::filesystem;
  const auto refuse = [&masks](std::string_view message) {
    return failure(ErrorKind::kInput, fmt::format("{}: {}", masks.string(), message));
  };
  std::error_code ignored;
  if (!fs::is_directory(masks, ignored)) return refuse("no such folder of masks; check the path");
  std::map<fs::path, std::string> view_of;
  for (View& view : views) {
    const std::string with_extension = view.image_name + ".png";
    const std::string alone = fs::path(view.image_name).replace_extension(".png").string();
    fs::path found;
    for (const std::string& name : {with_extension, alone})
      if (found.empty()) found = find_photograph_by_end(masks, name);
    if (found.empty()) return refuse(fmt::format("no mask {} or {} for view {}", with_extension, alone, view.name));
    const auto [other, is_new] = view_of.emplace(found, view.image_name);
    if (!is_new && fs::path(view.image_name).has_parent_path())
      return refuse(fmt::format("{} would be the mask of both {} and {}; put masks into folders as the photographs are",
                                found.filename().string(), other->second, view.image_name));
    view.mask_path = found;
  }
  return {};
}

}  // namespace quorum
