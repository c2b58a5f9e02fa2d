#include "engine/depth/small_images.h"

#include "engine/image/halve.h"

namespace quorum {
namespace {

PaddedImage halved(const PaddedImage& image) {
  ColorImage colors(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) colors.at(x, y) = image.at(x, y);
  return pad_image(halve_image(colors));
}

}  // namespace

std::shared_ptr<const PaddedImage> SmallImages::of(const std::shared_ptr<const PaddedImage>& image, int halvings) {
  if (halvings == 0) return image;
  const Key key{image.get(), halvings};
  if (auto there = find(key)) return there;
  auto small = std::make_shared<const PaddedImage>(halved(*of(image, halvings - 1)));
  const std::scoped_lock lock(mutex_);
  return entries_.try_emplace(key, Entry{image, std::move(small)}).first->second.small;  // or another thread's
}

/// Drops those whose image is gone first, since another one may stand there by now.
std::shared_ptr<const PaddedImage> SmallImages::find(Key key) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(entries_, [](const auto& entry) { return entry.second.image.expired(); });
  const auto there = entries_.find(key);
  return there == entries_.end() ? nullptr : there->second.small;
}

}  // namespace quorum
