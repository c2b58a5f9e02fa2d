// A mesh with the photographs on it (Waechter, Moehrle, Goesele 2014, "Let There Be Color! Large-Scale Texturing of 3D
// Reconstructions"). docs/texture.md tells the idea.
#pragma once

#include <functional>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/option.h"
#include "engine/io/image_store.h"
#include "engine/mesh/textured_mesh.h"
#include "engine/scene/scene.h"

namespace quorum {

struct TextureOptions {
  int page_size = 8192;    ///< largest side of a page, pixels
  double band_pixels = 8;  ///< over which one photograph passes into the next; 0 = it doesn't
  bool level = true;       ///< fit the colors of patches to each other
};

/// The options under their names.
const std::vector<Option<TextureOptions>>& texture_option_table();

/// What the caller wants to know, and may refuse.
struct TextureWatch {
  /// That so many bytes will be held beside what the process holds now, and what for; fails (kMemory).
  std::function<Expected<void>(std::uint64_t bytes, std::string_view what_for)> require =
      [](std::uint64_t, std::string_view) { return Expected<void>(); };
  std::function<void(std::string_view name, int steps)> stage = [](std::string_view, int) {};
  std::function<Expected<void>()> step = [] { return Expected<void>(); };  ///< fails (kStopped) to end the work
};

struct TextureCounts {
  std::size_t triangles = 0;
  std::size_t unseen = 0;  ///< of them, by every photograph
  std::size_t patches = 0;
  std::size_t views = 0;  ///< whose photographs are on the mesh
};

struct Textured {
  TexturedMesh mesh = {};
  TextureCounts counts = {};
};

/// Textures a mesh in the scene's frame; photographs come from images one at a time, three times each. What
/// make_manifold mends is mended first. The same bytes on every machine and with any number of threads. Fails (kInput)
/// if the mesh has no triangles, no photograph shows any of them, or a photograph can't be read; (kMemory, kStopped) as
/// watch does.
Expected<Textured> texture_mesh(const Mesh& mesh, const Scene& scene, ImageStore& images, const TextureOptions& options,
                                const TextureWatch& watch = {});

}  // namespace quorum
