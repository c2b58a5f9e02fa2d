// Which files of a view's maps a run writes.
#pragma once

namespace quorum {

enum class Previews {
  kFull,   ///< as large as the maps
  kSmall,  ///< at most kSmallPreview pixels wide
  kNone,
};
constexpr int kSmallPreview = 512;

enum class SavedMaps {
  kAll,     ///< also correlation, which no stage reads
  kNeeded,  ///< what a later stage may read, and COLMAP's workspace: depth, confidence, normals, certainty
  kLeast,  ///< what this run's own stages read: depth; confidence or certainty; normals unless no stage asks for planes
};

/// The maps of a view's depth map that are written beside its depth, and previews.
struct SavedFiles {
  bool correlation = true;
  bool confidence = true;
  bool normals = true;  ///< if there are any
  Previews previews = Previews::kSmall;
};

}  // namespace quorum
