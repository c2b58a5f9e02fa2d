#include "tests/host/api/api_scene.h"

#include "engine/io/image_file.h"

namespace quorum {

OwnedArrays arrays_of(const v0::Scene& scene, const std::filesystem::path& folder) {
  OwnedArrays owned;
  for (int index = 0; index < scene.view_count(); ++index) {
    const v0::ViewInfo info = scene.view(index);
    const auto image = read_image(folder / info.image_name);
    if (!image) {
      ADD_FAILURE() << image.error().message;
      return owned;
    }
    const int padding = index % 2 == 0 ? 5 : 0;
    const bool is_bgr = index % 3 == 0;
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < image->height; ++y) {
      for (int x = 0; x < image->width; ++x) {
        const Rgba pixel = image->at(x, y);
        const std::uint32_t first = is_bgr ? blue_of(pixel) : red_of(pixel);
        const std::uint32_t last = is_bgr ? red_of(pixel) : blue_of(pixel);
        for (const std::uint32_t channel : {first, green_of(pixel), last})
          pixels.push_back(static_cast<std::uint8_t>(channel));
      }
      pixels.insert(pixels.end(), static_cast<std::size_t>(padding), std::uint8_t{77});
    }
    owned.pixels.push_back(std::move(pixels));
    v0::ViewArrays view;
    view.name = info.image_name;
    view.image = {owned.pixels.back().data(), image->width, image->height, 3, 3 * image->width + padding, is_bgr};
    view.camera = info.camera;
    owned.arrays.views.push_back(view);
  }
  owned.arrays.bounds = scene.bounds();
  return owned;
}

OwnedArrays flat_arrays() {
  OwnedArrays owned;
  owned.pixels.emplace_back(16 * 12, std::uint8_t{100});
  for (int index = 0; index < 3; ++index) {
    v0::ViewArrays view;
    view.image = {owned.pixels.back().data(), 16, 12, 1};
    view.camera.intrinsics = {20, 0, 8, 0, 20, 6, 0, 0, 1};
    view.camera.translation = {-0.2 * index, 0, 3};
    owned.arrays.views.push_back(view);
  }
  owned.arrays.bounds = {-1, -1, -1, 1, 1, 1};
  return owned;
}

}  // namespace quorum
