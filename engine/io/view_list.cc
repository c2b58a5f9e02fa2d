#include "engine/io/view_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/io/image_size.h"

namespace quorum {
namespace {

std::string without_slashes(std::string text) {
  std::ranges::replace(text, '/', '_');
  return text;
}

std::string short_name(const View& view) {
  return without_slashes(std::filesystem::path(view.image_name).replace_extension().string());
}

}  // namespace

Expected<void> ViewList::add(const std::string& image_name, const std::filesystem::path& image_path, const Camera& pose,
                             Lens lens) {
  const auto refuse = [&](std::string_view message) {
    return failure(ErrorKind::kInput, fmt::format("image \"{}\": {}", image_name, message));
  };
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(image_path, ignored))
    return refuse(fmt::format("{} is not there; add it or give its folder with --images", image_path.string()));
  const auto size = read_image_size(image_path);
  if (!size) return std::unexpected(size.error());
  if (lens.width == 0 && lens.height == 0) {
    lens.width = size->width;
    lens.height = size->height;
  }
  if (*size != ImageSize{lens.width, lens.height})
    return refuse(fmt::format("{} is {} x {}, its camera {} x {}; give the photographs that the cameras were found for",
                              image_path.string(), size->width, size->height, lens.width, lens.height));

  View view;
  view.image_name = image_name;
  view.image_path = image_path;
  view.camera = pose;
  view.camera.intrinsics << lens.focal.x(), 0, lens.principal.x(), 0, lens.focal.y(), lens.principal.y(), 0, 0, 1;
  view.width = lens.width;
  view.height = lens.height;
  if (const char* defect = camera_defect(view.camera); defect != nullptr) return refuse(defect);
  if (!lens.is_pinhole()) {
    const auto picture = pinhole_picture(lens);
    if (!picture) return refuse("its lens can't be undistorted; check its coefficients");
    view.camera.intrinsics = picture->intrinsics;
    view.width = picture->width;
    view.height = picture->height;
    view.photo_width = lens.width;
    view.photo_height = lens.height;
    view.lens = lens;
  }
  views_.push_back(std::move(view));
  return {};
}

Expected<std::vector<View>> ViewList::finish() {
  if (views_.size() < 3)
    return failure(
        ErrorKind::kInput,
        fmt::format("holds {} views, expected 3 or more: a reference view and two neighbors", views_.size()));
  std::map<std::string, int> uses;
  for (const View& view : views_) ++uses[short_name(view)];
  std::map<std::string, const View*> named;
  for (View& view : views_) {
    view.name = short_name(view);
    if (uses[view.name] > 1) view.name = without_slashes(view.image_name);
    const auto [other, is_new] = named.emplace(view.name, &view);
    if (!is_new)
      return failure(ErrorKind::kInput, fmt::format("images \"{}\" and \"{}\" would have one name; rename one",
                                                    other->second->image_name, view.image_name));
  }
  return std::move(views_);
}

}  // namespace quorum
