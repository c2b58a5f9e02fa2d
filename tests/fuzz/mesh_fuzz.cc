// PLY files: a mesh whose positions are finite and whose triangles have vertices, or a line.
#include <algorithm>
#include <cstdlib>

#include "engine/io/ply.h"
#include "tests/fuzz/fuzz_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const auto mesh = quorum::read_ply(quorum::write_input({reinterpret_cast<const char*>(data), size}, ".ply"));
  if (!mesh) return 0;
  const std::size_t count = mesh->vertices.size();
  const auto has_corners = [count](const auto& triangle) {
    return std::ranges::all_of(triangle, [count](auto index) { return index < count; });
  };
  const auto is_finite = [](const quorum::Vertex& vertex) { return vertex.position.allFinite(); };
  if (!std::ranges::all_of(mesh->vertices, is_finite) || !std::ranges::all_of(mesh->triangles, has_corners))
    std::abort();
  return 0;
}
