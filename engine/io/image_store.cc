#include "engine/io/image_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <type_traits>

#include "engine/camera/pinhole_picture.h"
#include "engine/core/check.h"
#include "engine/image/halve.h"
#include "engine/io/image_file.h"
#include "engine/io/image_size.h"
#include "engine/io/undistort.h"

namespace quorum {
namespace {

template <typename T>
std::size_t byte_count(const Grid<T>& grid) {
  return grid.values.size() * sizeof(T);
}

/// What is done to the pixels of a file.
template <typename T>
struct Steps {
  Expected<Grid<T>> (*read)(const std::filesystem::path&);
  Expected<Grid<T>> (*undistort)(const Grid<T>&, const Lens&, const PinholePicture&);
  Grid<T> (*halve)(const Grid<T>&);
};

/// Decodes a file of a view, requires the size of its photograph, undistorts it if the view has a lens, and halves it.
template <typename T>
Expected<Grid<T>> load(const View& view, const std::filesystem::path& path, const Steps<T>& steps) {
  const int width = view.photo_width > 0 ? view.photo_width : view.width;
  const int height = view.photo_width > 0 ? view.photo_height : view.height;
  const auto check_size = [&](ImageSize size) -> Expected<void> {
    if (size == ImageSize{width, height}) return {};
    return failure(ErrorKind::kInput,
                   fmt::format("{}: is {} x {}, expected {} x {} for its camera; replace it or leave its view out",
                               path.string(), size.width, size.height, width, height));
  };
  // Before it is decoded: a small file can hold a picture that is larger than the memory.
  QUORUM_ASSIGN(const ImageSize told, read_image_size(path));
  constexpr double kSmallest = 0.12;  // images_8; one that is much larger takes memory that no budget was asked for
  const auto factor = common_factor(told, {width, height});
  const bool is_scaled_mask =  // the photographs were made smaller, the masks not
      std::is_same_v<T, std::uint8_t> && told.width != width && factor && *factor > kSmallest;
  if (!is_scaled_mask) QUORUM_TRY(check_size(told));
  auto pixels = steps.read(path);
  if (!pixels) return pixels;
  if constexpr (std::is_same_v<T, std::uint8_t>)
    if (is_scaled_mask) *pixels = scale_mask(*pixels, width, height);
  QUORUM_TRY(check_size({pixels->width, pixels->height}));
  if (view.lens) {
    const auto picture = pinhole_picture(*view.lens);
    QUORUM_CHECK_EQ(picture.has_value(), true);
    pixels = steps.undistort(*pixels, *view.lens, *picture);
    if (!pixels) return pixels;
  }
  for (int i = 0; i < view.halvings; ++i) *pixels = steps.halve(*pixels);
  return pixels;
}

}  // namespace

ImageStore::ImageStore(const Scene& scene, std::size_t budget_bytes, double mask_below)
    : scene_(&scene), budget_bytes_(budget_bytes), mask_below_(mask_below) {}

Expected<ColorImage> ImageStore::load_image(int view) const {
  const View& source = view_at(view);
  return load(source, source.image_path, Steps<Rgba>{read_image, undistort_image, halve_image});
}

Expected<std::shared_ptr<const ColorImage>> ImageStore::image(int view) {
  const Key key{Kind::kImage, view};
  if (auto kept = find(key)) return std::static_pointer_cast<const ColorImage>(kept);
  auto loaded = load_image(view);
  if (!loaded) return std::unexpected(std::move(loaded.error()));
  const std::size_t bytes = byte_count(*loaded);
  return std::static_pointer_cast<const ColorImage>(
      keep(key, std::make_shared<const ColorImage>(std::move(*loaded)), bytes));
}

Expected<std::shared_ptr<const PaddedImage>> ImageStore::padded(int view) {
  const Key key{Kind::kPadded, view};
  if (auto kept = find(key)) return std::static_pointer_cast<const PaddedImage>(kept);
  const auto make = [&]() -> Expected<PaddedImage> {
    if (const auto kept = find({Kind::kImage, view}))
      return pad_image(*std::static_pointer_cast<const ColorImage>(kept));
    QUORUM_ASSIGN(const ColorImage image, load_image(view));
    return pad_image(image);
  };
  QUORUM_ASSIGN(PaddedImage image, make());
  const std::size_t bytes = image.pixels.size() * sizeof(Rgba) * 4 / 3;
  return std::static_pointer_cast<const PaddedImage>(
      keep(key, std::make_shared<const PaddedImage>(std::move(image)), bytes));
}

Expected<std::shared_ptr<const Mask>> ImageStore::mask(int view) {
  if (view_at(view).mask_path.empty() && mask_below_ <= 0.0) return std::make_shared<const Mask>();
  const Key key{Kind::kMask, view};
  if (auto kept = find(key)) return std::static_pointer_cast<const Mask>(kept);
  auto loaded = load_mask(view);
  if (!loaded) return std::unexpected(std::move(loaded.error()));
  const std::size_t bytes = byte_count(*loaded);
  return std::static_pointer_cast<const Mask>(keep(key, std::make_shared<const Mask>(std::move(*loaded)), bytes));
}

std::size_t ImageStore::kept_bytes() const {
  const std::lock_guard lock(mutex_);
  return kept_bytes_;
}

const View& ImageStore::view_at(int view) const {
  QUORUM_CHECK_GE(view, 0);
  QUORUM_CHECK_LT(static_cast<std::size_t>(view), scene_->views.size());
  return scene_->views[static_cast<std::size_t>(view)];
}

Expected<Mask> ImageStore::load_mask(int view) {
  const View& source = view_at(view);
  Mask mask(source.width, source.height, 1);
  if (!source.mask_path.empty()) {
    const auto read = source.mask_path == source.image_path ? read_alpha : read_mask;
    auto from_file = load(source, source.mask_path, Steps<std::uint8_t>{read, undistort_mask, halve_mask});
    if (!from_file) return from_file;
    mask = std::move(*from_file);
  }
  if (mask_below_ > 0.0) {
    QUORUM_ASSIGN(const auto photograph, image(view));
    const Mask object = mask_dark_background(*photograph, mask_below_);
    std::ranges::transform(mask.values, object.values, mask.values.begin(), std::bit_and<>());
  }
  return mask;
}

std::shared_ptr<const void> ImageStore::find(Key key) {
  const std::lock_guard lock(mutex_);
  const auto place = places_.find(key);
  if (place == places_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, place->second);
  return place->second->value;
}

/// Keeps a value within the budget; returns it, or the one that another thread has kept meanwhile.
std::shared_ptr<const void> ImageStore::keep(Key key, std::shared_ptr<const void> value, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (const auto place = places_.find(key); place != places_.end()) return place->second->value;
  if (bytes > budget_bytes_) return value;
  while (kept_bytes_ > budget_bytes_ - bytes) {
    kept_bytes_ -= entries_.back().bytes;
    places_.erase(entries_.back().key);
    entries_.pop_back();
  }
  entries_.push_front({key, value, bytes});
  places_.emplace(key, entries_.begin());
  kept_bytes_ += bytes;
  return value;
}

}  // namespace quorum
