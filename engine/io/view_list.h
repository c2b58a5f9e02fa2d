// What all readers of cameras do with a photograph: check it, name it, undistort it.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/scene/scene.h"

namespace quorum {

/// Collects the views of a scene, and what is to be said of their photographs.
class ViewList {
 public:
  /// Adds a photograph; the result is the place of its view. image_name: what the scene calls it. image_path: its file,
  /// or empty if there is none: the view is left out, and the result is -1. pose: its intrinsics are ignored. lens: of
  /// the photograph; the view gets its pinhole picture. A lens without distortion gives a view as it is; where its
  /// width and height are 0 they are taken from the photograph. A photograph of another size gets a lens of its size if
  /// the sides differ by one factor (common_factor). One with an alpha channel is its own mask. Fails (kInput) if the
  /// photograph has another size than the lens otherwise, two views have one photograph, the name has control
  /// characters, or the camera or the lens is none, or is no photograph's.
  Expected<int> add(const std::string& image_name, const std::filesystem::path& image_path, const Camera& pose,
                    Lens lens);

  /// The scene of these views with names (name_views), without bounds and points, and with notes of photographs that
  /// are absent, have another size, or a principal point far off. Fails (kInput) if there are fewer than three views,
  /// or two of one image.
  Expected<Scene> finish();

 private:
  std::vector<View> views_;
  std::set<std::filesystem::path> photographs_;
  std::vector<std::string> absent_;
  std::vector<std::string> off_center_;
  std::size_t scaled_count_ = 0;
  double least_factor_ = 0.0;
  double largest_factor_ = 0.0;
  std::size_t alpha_count_ = 0;
};

/// "a.png, b.png", of more than a few with " …" in place of the rest.
std::string names_in_short(const std::vector<std::string>& names);
/// "2 of 23 photographs are not there and were left out: a.png, b.png". names: of those, not empty.
std::string absent_note(const std::vector<std::string>& names, std::size_t count);
/// "3 photographs have an alpha channel, which is taken as their mask".
std::string alpha_note(std::size_t count);

}  // namespace quorum
