// Photographs on a device, kept there from view to view: each is the neighbor of several.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "engine/image/padded_image.h"
#include "host/buffer.h"
#include "host/commands.h"

namespace quorum {

/// Keeps the images that the host still has, those used least recently dropped first, in a quarter of the device's
/// memory. Nothing on a device that reads the host's memory: there a copy gains nothing.
class ResidentImages {
 public:
  explicit ResidentImages(Commands& commands);
  /// most_bytes: that are kept.
  ResidentImages(Commands& commands, std::uint64_t most_bytes) : commands_(&commands), most_bytes_(most_bytes) {}

  /// The pixels of an image, uploaded unless they are there. The commands keep a failure.
  Buffer of(const std::shared_ptr<const PaddedImage>& image);

  /// Drops all, as after a failure, when what was recorded has not run.
  void clear();

 private:
  struct Entry {
    std::weak_ptr<const PaddedImage> image;
    Buffer pixels;
    std::uint64_t last_use = 0;
  };

  void drop_gone();
  void drop_least_recent();
  void drop(std::map<const PaddedImage*, Entry>::iterator place);

  Commands* commands_;
  std::uint64_t most_bytes_;
  std::map<const PaddedImage*, Entry> entries_;
  std::uint64_t bytes_ = 0;  ///< of the entries
  std::uint64_t uses_ = 0;
};

}  // namespace quorum
