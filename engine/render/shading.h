// The color of a piece of surface in a picture (RenderOptions::Shading), for triangles and points alike.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/render/render.h"

namespace quorum {

using Color = Eigen::Vector3f;  ///< red, green, blue, 0..255

inline const Color kBackground = Color::Constant(255);

/// What is seen of a surface along a ray.
struct SurfaceSample {
  Color color;
  float confidence = 0;
  Eigen::Vector3f normal;  ///< camera axes, unit length, toward the side that is seen
  bool is_back = false;    ///< the inside is seen
};

Color vertex_color(const Vertex& vertex);

/// The sample as options.shading says, tinted blue on the back. to_camera: unit length, camera axes.
Color shade(const SurfaceSample& sample, const Eigen::Vector3f& to_camera, const RenderOptions& options);

/// Rounded and clamped; what is no number becomes 0.
Rgba to_pixel(const Color& color);

/// The options with the confidence that is drawn as yellow, if they leave it to the mesh.
RenderOptions settle(const RenderOptions& options, const Mesh& mesh);

}  // namespace quorum
