#include "engine/io/scene_pictures.h"

#include <algorithm>
#include <set>

#include "engine/io/file.h"
#include "engine/io/image_store.h"
#include "engine/io/output_folder.h"
#include "engine/io/view_names.h"
#include "engine/io/write_image.h"

namespace quorum {

bool needs_new_pictures(const Scene& scene) {
  return std::ranges::any_of(scene.views, [](const View& view) { return view.lens || view.halvings > 0; });
}

namespace {

/// True if the scene's own names of its photographs may be the names of files of ours.
bool has_plain_names(const Scene& scene) {
  std::set<std::string> names;
  return std::ranges::all_of(scene.views, [&names](const View& view) {
    return is_plain_path(view.image_name) && names.insert(folded(view.image_name)).second;
  });
}

/// The extension of a photograph's file, if it is an ordinary one.
std::string extension_of(const View& view) {
  const std::string extension = view.image_path.extension().string();
  return extension.size() <= 5 && is_plain_path("x" + extension) ? extension : std::string();
}

}  // namespace

std::vector<std::string> picture_names(const Scene& scene) {
  const bool anew = needs_new_pictures(scene);
  const bool plain = has_plain_names(scene);
  std::vector<std::string> names;
  for (const View& view : scene.views)
    names.push_back(anew ? view.name + ".png" : plain ? view.image_name : view.name + extension_of(view));
  return names;
}

Expected<void> write_pictures(const std::filesystem::path& folder, const Scene& scene,
                              const std::vector<std::string>& names) {
  const bool anew = needs_new_pictures(scene);
  QUORUM_ASSIGN(auto output, OutputFolder::open(folder.parent_path()));
  ImageStore images(scene, 0);
  for (std::size_t index = 0; index < names.size(); ++index) {
    Expected<std::string> bytes;
    if (anew) {
      QUORUM_ASSIGN(const auto image, images.image(static_cast<int>(index)));
      bytes = encode_png(*image);
    } else {
      bytes = read_file(scene.views[index].image_path);
    }
    if (!bytes) return std::unexpected(bytes.error());
    QUORUM_TRY(output.write(folder.filename() / names[index], *bytes));
  }
  return {};
}

}  // namespace quorum
