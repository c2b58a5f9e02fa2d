// Textured meshes as Wavefront OBJ with MTL and pictures.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/mesh/textured_mesh.h"

namespace quorum {

/// The line of a vertex: its place with the mesh's offset, and a color, as MeshLab and Blender read them.
std::string obj_vertex(const Mesh& mesh, const Vertex& vertex, Rgba color);

/// Writes NAME.obj, NAME.mtl and, for each page, NAME-1.jpg or NAME-1.png and so on (page_ending), all beside path, the
/// OBJ last. Triangles without a page are of the material "unseen" and have the colors of their vertices; other
/// vertices are white, so that programs that multiply by colors change nothing. Fails (kInput) if a file can't be
/// written.
Expected<void> write_obj(const std::filesystem::path& path, const TexturedMesh& mesh, std::string_view page_ending);

}  // namespace quorum
