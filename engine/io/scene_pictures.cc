#include "engine/io/scene_pictures.h"

#include <algorithm>

#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/image_store.h"

namespace quorum {

bool needs_new_pictures(const Scene& scene) {
  return std::ranges::any_of(scene.views, [](const View& view) { return view.lens || view.halvings > 0; });
}

std::vector<std::string> picture_names(const Scene& scene) {
  const bool anew = needs_new_pictures(scene);
  std::vector<std::string> names;
  for (const View& view : scene.views) names.push_back(anew ? view.name + ".png" : view.image_name);
  return names;
}

Expected<void> write_pictures(const std::filesystem::path& folder, const Scene& scene,
                              const std::vector<std::string>& names) {
  const bool anew = needs_new_pictures(scene);
  ImageStore images(scene, 0);
  for (std::size_t index = 0; index < names.size(); ++index) {
    const std::filesystem::path path = folder / names[index];
    if (auto made = make_folder(path.parent_path()); !made) return made;
    Expected<void> written;
    if (anew) {
      const auto image = images.image(static_cast<int>(index));
      if (!image) return std::unexpected(image.error());
      written = write_png(path, **image);
    } else {
      const auto bytes = read_file(scene.views[index].image_path);
      if (!bytes) return std::unexpected(bytes.error());
      written = write_file(path, *bytes);
    }
    if (!written) return written;
  }
  return {};
}

}  // namespace quorum
