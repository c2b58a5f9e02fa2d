#include "engine/report/packed_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/report/data_url.h"

namespace quorum {
namespace {

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

}  // namespace

PackedMesh pack_mesh(const Mesh& mesh, const std::vector<int>& views, float full_confidence) {
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : mesh.vertices) box.extend(vertex.position);
  PackedMesh result;
  if (mesh.vertices.empty()) return result;
  result.low = box.min();
  result.size = box.sizes();
  std::vector<std::uint16_t> positions;
  std::vector<std::uint8_t> colors;
  std::vector<std::uint8_t> confidences;
  std::vector<std::uint8_t> counts;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vertex& vertex = mesh.vertices[i];
    for (int axis = 0; axis < 3; ++axis) {
      const float size = std::max(result.size[axis], 1e-30F);
      positions.push_back(
          static_cast<std::uint16_t>(std::lround((vertex.position[axis] - result.low[axis]) / size * 65535.0F)));
    }
    for (const std::uint32_t level : {red_of(vertex.color), green_of(vertex.color), blue_of(vertex.color)})
      colors.push_back(static_cast<std::uint8_t>(level));
    confidences.push_back(to_byte(vertex.confidence / full_confidence));
    counts.push_back(static_cast<std::uint8_t>(std::min(views[i], 255)));
  }
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  result.positions = base64_of(positions);
  result.colors = base64_of(colors);
  result.confidence = base64_of(confidences);
  result.views = base64_of(counts);
  result.triangles = base64_of(corners);
  return result;
}

}  // namespace quorum
