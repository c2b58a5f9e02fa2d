// Meshes and clouds as binary glTF 2.0 (Khronos, ISO/IEC 12113), which browsers, Blender and game engines open.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/mesh/textured_mesh.h"

namespace quorum {

/// Writes one primitive of triangles or, without them, of points: POSITION, NORMAL, COLOR_0 (linear, 16 bits, as glTF
/// wants it), _CONFIDENCE (float, as in Vertex) and indices of 32 bits. The material is unlit: light is in the
/// photographs already. The offset of a mesh is the translation of its node. An axis that points up is not known, so
/// none is turned. A vertex without a normal gets one that its triangles have together, or +z. The same bytes on every
/// machine. Fails (kInput) for an empty mesh, one of more than the 4 GiB that the format holds, or if the file can't be
/// written.
Expected<void> write_glb(const std::filesystem::path& path, const Mesh& mesh);

/// The same with a primitive for each page, which has TEXCOORD_0 in place of COLOR_0 and a material with the page in
/// it, and one with COLOR_0 and a material called "unseen" for the triangles without a page. Pages are JPEG files
/// (page_ending .jpg) or PNG files (.png) inside of the file. The same bytes wherever the library of that format is the
/// same. Fails as above, and (kInput) for a page that its format does not hold.
Expected<void> write_glb(const std::filesystem::path& path, const TexturedMesh& mesh, std::string_view page_ending);

/// Reads a file that either write_glb wrote; without textures it has no pages. What other programs make of such a file
/// may be refused. offset: as in read_ply. Fails (kInput) if the file can't be read or is not as they write it.
Expected<TexturedMesh> read_glb(const std::filesystem::path& path, const std::optional<Eigen::Vector3d>& offset = {});

/// A page as the bytes of a file; ending: .jpg or .png. Fails (kInput) if its format does not hold it.
Expected<std::string> encode_page(const ColorImage& page, std::string_view ending);

}  // namespace quorum
