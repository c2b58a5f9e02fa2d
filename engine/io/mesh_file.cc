#include "engine/io/mesh_file.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>

#include "engine/core/version.h"
#include "engine/io/file.h"
#include "engine/io/glb.h"
#include "engine/io/ply.h"
#include "engine/io/textured_obj.h"
#include "engine/mesh/make_manifold.h"

namespace quorum {
namespace {

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// 1-based indices; a point that no triangle uses is a "p" element, which viewers draw.
std::string obj_bytes(const Mesh& mesh) {
  std::string text = fmt::format("# Quorum {}\n", version());
  const auto out = std::back_inserter(text);
  for (const Vertex& vertex : mesh.vertices) text += obj_vertex(mesh, vertex, vertex.color);
  for (const Vertex& vertex : mesh.vertices)
    fmt::format_to(out, "vn {} {} {}\n", vertex.normal.x(), vertex.normal.y(), vertex.normal.z());
  for (const auto& triangle : mesh.triangles)
    fmt::format_to(out, "f {0}//{0} {1}//{1} {2}//{2}\n", triangle[0] + 1, triangle[1] + 1, triangle[2] + 1);
  if (mesh.triangles.empty())
    for (std::size_t i = 1; i <= mesh.vertices.size(); ++i) fmt::format_to(out, "p {}\n", i);
  return text;
}

/// 80 bytes that say nothing to readers but the offset, which floats can't take, a count, then 50 bytes a triangle:
/// normal, corners, two bytes of zero.
std::string stl_bytes(const Mesh& mesh) {
  std::string bytes = fmt::format("Quorum {}", version());
  if (!mesh.offset.isZero(0.0))
    bytes += fmt::format(" offset {} {} {}", mesh.offset.x(), mesh.offset.y(), mesh.offset.z());
  bytes.resize(80, ' ');
  const auto append = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  bytes.reserve(bytes.size() + mesh.triangles.size() * 50);
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](int i) -> const Eigen::Vector3f& { return mesh.vertices[triangle[i]].position; };
    const Eigen::Vector3d along = (corner(1) - corner(0)).cast<double>();
    const Eigen::Vector3f normal = along.cross((corner(2) - corner(0)).cast<double>()).normalized().cast<float>();
    for (const Eigen::Vector3f* vector :
         std::initializer_list<const Eigen::Vector3f*>{&normal, &corner(0), &corner(1), &corner(2)})
      for (const float value : *vector) append(value);
    append(std::uint16_t{0});
  }
  return bytes;
}

}  // namespace

Expected<void> check_mesh_ending(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".ply" || ending == ".glb" || ending == ".obj" || ending == ".stl") return {};
  return failure(ErrorKind::kUsage,
                 fmt::format("{}: no format of meshes; end the name in .ply, .glb, .obj or .stl", path.string()));
}

Expected<void> check_textured_ending(const std::filesystem::path& path) {
  if (ending_of(path) == ".glb" || ending_of(path) == ".obj") return {};
  return failure(ErrorKind::kUsage,
                 fmt::format("{}: holds no textured mesh; end the name in .glb or .obj", path.string()));
}

Expected<void> write_textured(const std::filesystem::path& path, const TexturedMesh& mesh,
                              std::string_view page_ending) {
  QUORUM_TRY(check_textured_ending(path));
  return ending_of(path) == ".glb" ? write_glb(path, mesh, page_ending) : write_obj(path, mesh, page_ending);
}

Expected<void> write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  QUORUM_TRY(check_mesh_ending(path));
  const Mesh whole = make_manifold(mesh);
  const std::string ending = ending_of(path);
  if (ending == ".ply") return write_ply(path, whole);
  if (ending == ".glb") return write_glb(path, whole);
  if (ending == ".obj") return write_file(path, obj_bytes(whole));
  if (whole.triangles.empty())
    return failure(ErrorKind::kInput,
                   fmt::format("{}: STL holds triangles alone; write a cloud as .ply or .glb", path.string()));
  return write_file(path, stl_bytes(whole));
}

}  // namespace quorum
