// GLB files: a mesh that all who draw it can take as it is, or a line.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/io/glb.h"
#include "tests/fuzz/fuzz_folder.h"

namespace {

bool rises_to(const std::vector<std::uint32_t>& firsts, std::size_t pages, std::size_t count) {
  return firsts.size() == pages + 2 && std::ranges::is_sorted(firsts) && firsts.back() == count;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto model = quorum::read_glb(quorum::write_input({reinterpret_cast<const char*>(data), size}, ".glb"));
  if (!model) {
    if (model.error().message.empty()) std::abort();
    return 0;
  }
  const quorum::Mesh& mesh = model->mesh;
  const auto has_corners = [&](const auto& triangle) {
    return std::ranges::all_of(triangle, [&](auto index) { return index < mesh.vertices.size(); });
  };
  const auto is_sound = [](const quorum::Vertex& vertex) {
    return vertex.position.allFinite() && vertex.normal.allFinite() && std::isfinite(vertex.confidence);
  };
  const auto is_inside = [](const auto& place) { return place.minCoeff() >= 0 && place.maxCoeff() <= 1; };
  const bool whole = std::ranges::all_of(mesh.vertices, is_sound) && std::ranges::all_of(mesh.triangles, has_corners) &&
                     model->coordinates.size() == mesh.vertices.size() &&
                     std::ranges::all_of(model->coordinates, is_inside) &&
                     rises_to(model->first_triangles, model->pages.size(), mesh.triangles.size()) &&
                     rises_to(model->first_vertices, model->pages.size(), mesh.vertices.size());
  if (!whole) std::abort();
  return 0;
}
