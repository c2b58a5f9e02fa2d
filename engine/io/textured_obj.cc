#include "engine/io/textured_obj.h"

#include <fmt/format.h>

#include <iterator>

#include "engine/core/version.h"
#include "engine/io/file.h"
#include "engine/io/glb.h"

namespace quorum {
namespace {

/// Light is in the photographs already.
std::string material(const std::string& name) {
  return fmt::format("newmtl {}\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 0\n", name);
}

std::string obj_text(const std::string& library, const TexturedMesh& mesh) {
  std::string text = fmt::format("# Quorum {}\nmtllib {}\n", version(), library);
  const auto out = std::back_inserter(text);
  const std::uint32_t first_unseen = mesh.first_vertices[mesh.pages.size()];
  for (std::uint32_t i = 0; i < mesh.mesh.vertices.size(); ++i) {
    const Vertex& vertex = mesh.mesh.vertices[i];
    text += obj_vertex(mesh.mesh, vertex, i < first_unseen ? make_rgb(255, 255, 255) : vertex.color);
  }
  for (const Eigen::Vector2f& place : mesh.coordinates)  // from the bottom here
    fmt::format_to(out, "vt {} {}\n", place.x(), 1 - place.y());
  for (const Vertex& vertex : mesh.mesh.vertices)
    fmt::format_to(out, "vn {} {} {}\n", vertex.normal.x(), vertex.normal.y(), vertex.normal.z());
  for (std::size_t page = 0; page <= mesh.pages.size(); ++page) {
    const bool unseen = page == mesh.pages.size();
    if (unseen && mesh.unseen_triangles() == 0) break;
    text += unseen ? std::string("usemtl unseen\n") : fmt::format("usemtl page{}\n", page + 1);
    for (std::uint32_t t = mesh.first_triangles[page]; t < mesh.first_triangles[page + 1]; ++t) {
      const auto& corners = mesh.mesh.triangles[t];
      fmt::format_to(out, "f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1);
    }
  }
  return text;
}

}  // namespace

std::string obj_vertex(const Mesh& mesh, const Vertex& vertex, Rgba color) {
  const auto level = [](std::uint32_t value) { return static_cast<float>(value) / 255.0F; };
  const auto coordinate = [&](int axis) {
    return mesh.offset.isZero(0.0) ? fmt::format("{}", vertex.position[axis])
                                   : fmt::format("{:.6f}", mesh.offset[axis] + double{vertex.position[axis]});
  };
  return fmt::format("v {} {} {} {:.4f} {:.4f} {:.4f}\n", coordinate(0), coordinate(1), coordinate(2),
                     level(red_of(color)), level(green_of(color)), level(blue_of(color)));
}

Expected<void> write_obj(const std::filesystem::path& path, const TexturedMesh& mesh, std::string_view page_ending) {
  const std::string stem = path.stem().string();
  std::string materials = fmt::format("# Quorum {}\n", version());
  for (std::size_t page = 0; page < mesh.pages.size(); ++page) {
    const std::string name = fmt::format("{}-{}{}", stem, page + 1, page_ending);
    const auto bytes = encode_page(mesh.pages[page], page_ending);
    if (!bytes) return std::unexpected(bytes.error().within(name));
    QUORUM_TRY(write_file(path.parent_path() / name, *bytes));
    materials += material(fmt::format("page{}", page + 1)) + fmt::format("map_Kd {}\n", name);
  }
  if (mesh.unseen_triangles() > 0) materials += material("unseen");
  QUORUM_TRY(write_file(path.parent_path() / (stem + ".mtl"), materials));
  return write_file(path, obj_text(stem + ".mtl", mesh));
}

}  // namespace quorum
