// A picture of a mesh as a camera sees it, for looking at results.
#pragma once

#include "engine/camera/camera.h"
#include "engine/core/error.h"
#include "engine/image/image.h"
#include "engine/mesh/textured_mesh.h"

namespace quorum {

struct RenderOptions {
  enum class Shading {
    kShaded,      ///< gray, lit from the camera and from the upper left
    kColor,       ///< vertex colors, unlit
    kConfidence,  ///< from dark red (0) over orange to yellow (full_confidence), unlit
    kNormal,      ///< x right, y up, z toward the camera as red, green, blue; -1..1 as 0..255
  };
  Shading shading = Shading::kShaded;
  float full_confidence = 0;  ///< confidence drawn as yellow, >= 0; 0 = the highest of the mesh

  /// Names the first option that is out of its range, and the range. kUsage.
  [[nodiscard]] Expected<void> check() const;
};

/// The mesh on white, width × height pixels (>= 0), each the mean of 2 × 2 samples. Where the inside of the surface is
/// seen (corners clockwise) it is tinted blue. Vertices without normal take those of their triangles. All white for a
/// mesh without triangles; triangles with a corner that is not finite are left out. The same picture for any number of
/// threads, but, as Embree's rounding differs, not for any CPU. Fails (kUsage) on options out of range, and (kMemory,
/// kDevice) if Embree can't build its search tree.
Expected<ColorImage> render_mesh(const Mesh& mesh, const Camera& camera, int width, int height,
                                 const RenderOptions& options);

/// The same of a textured mesh, with its pages in place of vertex colors. whole: if given, receives 1 for each pixel of
/// which all four samples meet the outside of the mesh, else 0.
Expected<ColorImage> render_textured(const TexturedMesh& mesh, const Camera& camera, int width, int height,
                                     const RenderOptions& options, Mask* whole = nullptr);

}  // namespace quorum
