// Images that were halved, made once for all sweeps that ask for them: a photograph is the neighbor of several views.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/image/padded_image.h"

namespace quorum {

/// Keeps the small images of an image as long as that is there. May be asked by several threads at once.
class SmallImages {
 public:
  /// The image halved this often (halve_image); 0: itself.
  std::shared_ptr<const PaddedImage> of(const std::shared_ptr<const PaddedImage>& image, int halvings);

 private:
  struct Entry {
    std::weak_ptr<const PaddedImage> image;
    std::shared_ptr<const PaddedImage> small;
  };
  using Key = std::pair<const PaddedImage*, int>;

  std::shared_ptr<const PaddedImage> find(Key key);

  std::mutex mutex_;  ///< guards what follows
  std::map<Key, Entry> entries_;
};

}  // namespace quorum
