// The synthetic temple: a small scene of analytic shapes with its exact surface, rendered from known cameras.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/image.h"
#include "engine/mesh/mesh.h"
#include "engine/scene/scene.h"

namespace quorum {

enum class CameraPath { kRing, kHemisphere };

/// kPerView: for each photograph the lights stand elsewhere and shine otherwise, as with the paper's skull (4.5).
enum class Lighting { kFixed, kPerView };

struct TempleOptions {
  int views = 16;  ///< 3..1024
  CameraPath path = CameraPath::kRing;
  int width = 640;       ///< pixels, 64..8192; the height is 3/4 of it
  double noise = 1.5;    ///< standard deviation of the sensor noise, gray levels, 0..64
  double texture = 1.0;  ///< strength of the stone texture, 0..4; 0 = plain plaster
  std::uint64_t seed = 1;
  double gloss = 0.0;  ///< strength of the highlights, 0..1; 0 = diffuse stone
  Lighting lighting = Lighting::kFixed;

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
};

/// Views (names temple0001…, image_path relative: temple0001.png …) and tight bounds, meters, y up; every third view is
/// upside down (turned by 180° about its optical axis), as in the Middlebury sets. options: must pass check().
Scene make_temple_scene(const TempleOptions& options);

/// The photograph of one view of that scene, view counted from 0. Same bytes for the same options, for any number of
/// threads. The light comes from three sides, with shadows; the background is black.
ColorImage render_temple(const Scene& scene, int view, const TempleOptions& options);

/// The exact surface as triangles with edges of at most max_edge (scene units). Faces covered by another solid (column
/// feet, the underside of a step) are left out; so is the ground that the temple stands on. Normals are set, vertices
/// are shared within a face only. Round faces deviate by at most 0.01 mm. max_edge: at least 0.1 mm.
Mesh temple_surface(double max_edge);

}  // namespace quorum
