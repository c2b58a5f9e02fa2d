// A mesh in the format that the ending of its name says.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/core/error.h"
#include "engine/mesh/textured_mesh.h"

namespace quorum {

/// Fails (kUsage) unless the path ends in .ply, .glb, .obj or .stl, in either case.
Expected<void> check_mesh_ending(const std::filesystem::path& path);

/// Writes a mesh or, in all formats but STL, a cloud, by way of a temporary file. PLY as write_ply does; GLB as
/// write_glb does; OBJ with colors behind the positions, as MeshLab and Blender read them, and normals; STL, binary,
/// has the triangles alone, and says the offset of the mesh in its first 80 bytes; the others add it, GLB by its node.
/// Triangles without area never get into a file. Fails (kUsage) for another ending, (kInput) if the file can't be
/// written, or for a cloud as STL.
Expected<void> write_mesh(const std::filesystem::path& path, const Mesh& mesh);

/// Fails (kUsage) unless the path ends in .glb or .obj, in either case.
Expected<void> check_textured_ending(const std::filesystem::path& path);

/// Writes a mesh with its pages, as write_glb or write_obj does. page_ending: .jpg or .png.
Expected<void> write_textured(const std::filesystem::path& path, const TexturedMesh& mesh,
                              std::string_view page_ending);

}  // namespace quorum
