// Meshes and clouds as PLY files (Turk 1994, "The PLY Polygon File Format").
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/mesh/mesh.h"

namespace quorum {

enum class PlyFrame { kWorld, kLocal };

/// Binary little-endian PLY: per vertex float x y z nx ny nz, uchar red green blue,
/// float confidence and quality (the same value: Stanford's tools and VripPack read confidence, MeshLab quality), then
/// faces as "list uchar int vertex_indices". A mesh without triangles is written as a cloud, without the face element.
/// A mesh with an offset: kWorld adds it and writes x y z in double; kLocal writes "comment offset x y z" for others to
/// add it.
/// Fails (kInput) if there are more elements than PLY's int can index.
Expected<std::string> encode_ply(const Mesh& mesh, PlyFrame frame = PlyFrame::kWorld);

/// Writes that through a temporary file. Fails (kInput) as encode_ply does, or if the file can't be written.
Expected<void> write_ply(const std::filesystem::path& path, const Mesh& mesh, PlyFrame frame = PlyFrame::kWorld);

/// Reads ASCII or binary (both byte orders) PLY with at least x y z. Other vertex properties are optional and may come
/// in any order: nx ny nz, red green blue (integers 0 to 255, or reals 0 to 1), confidence or else quality. A normal or
/// a confidence that is not finite counts as unknown. Faces with more than three corners are split into fans; other
/// elements and properties are skipped; without faces the result is a cloud. Fails (kInput) on a file that is
/// malformed, cut off or too long, a position that is not finite, or an index out of range: the message names the file
/// and the place. Memory is in proportion to the file's size, whatever its header says.
/// offset: of the mesh, taken off the positions in double (a scene's, or that of a mesh to compare with); without one
/// it is found, zero unless the positions lie far from their origin (far_offset).
Expected<Mesh> read_ply(const std::filesystem::path& path, const std::optional<Eigen::Vector3d>& offset = {});

}  // namespace quorum
