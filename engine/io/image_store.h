// The photographs and masks of a scene, loaded when a stage asks for them and kept within a budget of memory.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/core/error.h"
#include "engine/image/image.h"
#include "engine/image/padded_image.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Cache of decoded images and masks that drops what was used least recently. All members may be called from several
/// threads at once. No call waits for another one's file: two that miss the same image both decode it, and one result
/// is kept, so a task of a thread pool can never wait for itself.
class ImageStore {
 public:
  /// scene must outlive the store. budget_bytes: of decoded pixels kept for later, those of
  /// padded images with what their small ones take (a third more); what callers still hold is not
  /// counted, and an image above the budget is returned but not kept. mask_below: 0 = off; above 0, up to 1, masks also
  /// exclude the background that mask_dark_background finds at this level.
  ImageStore(const Scene& scene, std::size_t budget_bytes, double mask_below = 0.0);

  /// Image of a view (0 to views - 1): its photograph, undistorted if the view has a lens. Fails (kInput) if its file
  /// is absent, does not decode, or has another size than the view or the lens says.
  Expected<std::shared_ptr<const ColorImage>> image(int view);

  /// The same as sweeps read it. The image itself is kept only if something else asked for it.
  Expected<std::shared_ptr<const PaddedImage>> padded(int view);

  /// Mask of a view: 1 where its mask file, if it has one, at the photograph's size or another one of its shape, and
  /// the background mask, if that is on, both say that the pixel takes part. Empty if neither applies. Fails (kInput)
  /// as image() does.
  Expected<std::shared_ptr<const Mask>> mask(int view);

  /// Bytes that are kept now.
  [[nodiscard]] std::size_t kept_bytes() const;

 private:
  enum class Kind { kImage, kPadded, kMask };
  using Key = std::pair<Kind, int>;
  struct Entry {
    Key key;
    std::shared_ptr<const void> value;
    std::size_t bytes = 0;
  };

  [[nodiscard]] const View& view_at(int view) const;
  Expected<ColorImage> load_image(int view) const;
  Expected<Mask> load_mask(int view);
  std::shared_ptr<const void> find(Key key);
  std::shared_ptr<const void> keep(Key key, std::shared_ptr<const void> value, std::size_t bytes);

  const Scene* scene_;
  std::size_t budget_bytes_;
  double mask_below_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::list<Entry> entries_;  ///< most recently used first
  std::map<Key, std::list<Entry>::iterator> places_;
  std::size_t kept_bytes_ = 0;
};

}  // namespace quorum
