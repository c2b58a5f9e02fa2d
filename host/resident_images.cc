#include "host/resident_images.h"

#include <algorithm>

namespace quorum {

ResidentImages::ResidentImages(Commands& commands)
    : ResidentImages(commands,
                     commands.device().maps_buffers() ? 0 : commands.device().info().largest_device_heap / 4) {}

Buffer ResidentImages::of(const std::shared_ptr<const PaddedImage>& image) {
  drop_gone();  // first, since a new image may stand where one stood that is gone
  if (const auto there = entries_.find(image.get()); there != entries_.end()) {
    there->second.last_use = ++uses_;
    return there->second.pixels;
  }
  Buffer pixels = commands_->upload(image->pixels);
  if (pixels.size() == 0 || pixels.size() > most_bytes_) return pixels;
  while (bytes_ > most_bytes_ - pixels.size()) drop_least_recent();
  bytes_ += pixels.size();
  entries_.emplace(image.get(), Entry{image, pixels, ++uses_});
  return pixels;
}

void ResidentImages::clear() {
  entries_.clear();
  bytes_ = 0;
}

void ResidentImages::drop_gone() {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    const auto next = std::next(entry);
    if (entry->second.image.expired()) drop(entry);
    entry = next;
  }
}

void ResidentImages::drop_least_recent() {
  drop(std::ranges::min_element(entries_, {}, [](const auto& entry) { return entry.second.last_use; }));
}

void ResidentImages::drop(std::map<const PaddedImage*, Entry>::iterator place) {
  bytes_ -= place->second.pixels.size();
  entries_.erase(place);
}

}  // namespace quorum
