#include "engine/io/glb_primitive.h"

#include <Eigen/Geometry>
#include <cmath>

namespace quorum {
namespace {

using Numbers = std::array<float, 3>;

Numbers numbers_of(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// Unit normals of all vertices.
std::vector<Numbers> unit_normals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> sums(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](int i) { return mesh.vertices[triangle[i]].position.cast<double>().eval(); };
    const Eigen::Vector3d area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    for (const std::uint32_t index : triangle) sums[index] += area;
  }
  std::vector<Numbers> normals(mesh.vertices.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    Eigen::Vector3d normal = mesh.vertices[i].normal.cast<double>();
    if (normal.squaredNorm() == 0) normal = sums[i];
    if (normal.squaredNorm() == 0) normal = Eigen::Vector3d::UnitZ();
    normals[i] = numbers_of(normal.normalized().cast<float>());
  }
  return normals;
}

void add_positions(tinygltf::Model& model, Accessors& accessors, const Mesh& mesh, tinygltf::Primitive& primitive) {
  std::vector<Numbers> positions(mesh.vertices.size());
  Eigen::Vector3f low = mesh.vertices[0].position;
  Eigen::Vector3f high = low;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3f& position = mesh.vertices[i].position;
    positions[i] = numbers_of(position);
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  const int index =
      accessors.add(positions, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  for (int axis = 0; axis < 3; ++axis) {
    model.accessors[index].minValues.push_back(static_cast<double>(low[axis]));
    model.accessors[index].maxValues.push_back(static_cast<double>(high[axis]));
  }
  primitive.attributes["POSITION"] = index;
}

void add_colors(Accessors& accessors, const Mesh& mesh, tinygltf::Primitive& primitive) {
  const std::array<std::uint16_t, 256> linear = linear_levels();
  std::vector<std::array<std::uint16_t, 4>> colors;
  for (const Vertex& vertex : mesh.vertices)
    colors.push_back(
        {linear[red_of(vertex.color)], linear[green_of(vertex.color)], linear[blue_of(vertex.color)], 65535});
  primitive.attributes["COLOR_0"] =
      accessors.add(colors, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
}

void add_coordinates(Accessors& accessors, std::span<const Eigen::Vector2f> coordinates,
                     tinygltf::Primitive& primitive) {
  std::vector<std::array<float, 2>> values;
  for (const Eigen::Vector2f& place : coordinates) values.push_back({place.x(), place.y()});
  primitive.attributes["TEXCOORD_0"] =
      accessors.add(values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER);
}

}  // namespace

/// Levels of sRGB (IEC 61966-2-1) as linear light, 65535 = white. No level lies within 1e-4 of the middle of two
/// numbers, so that every libm gives these.
std::array<std::uint16_t, 256> linear_levels() {
  std::array<std::uint16_t, 256> levels{};
  for (int i = 0; i < 256; ++i) {
    const double value = i / 255.0;
    const double light = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    levels[i] = static_cast<std::uint16_t>(std::lround(light * 65535));
  }
  return levels;
}

tinygltf::Primitive make_primitive(tinygltf::Model& model, Accessors& accessors, const Mesh& mesh,
                                   std::span<const Eigen::Vector2f> coordinates, int material) {
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
  constexpr int kArray = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  primitive.mode = mesh.triangles.empty() ? TINYGLTF_MODE_POINTS : TINYGLTF_MODE_TRIANGLES;
  primitive.material = material;
  add_positions(model, accessors, mesh, primitive);
  primitive.attributes["NORMAL"] = accessors.add(unit_normals(mesh), kFloat, TINYGLTF_TYPE_VEC3, kArray);
  if (coordinates.empty())
    add_colors(accessors, mesh, primitive);
  else
    add_coordinates(accessors, coordinates, primitive);
  std::vector<float> confidences;
  for (const Vertex& vertex : mesh.vertices) confidences.push_back(vertex.confidence);
  primitive.attributes["_CONFIDENCE"] = accessors.add(confidences, kFloat, TINYGLTF_TYPE_SCALAR, kArray);
  if (mesh.triangles.empty()) return primitive;

  std::vector<std::uint32_t> indices;
  for (const auto& triangle : mesh.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  primitive.indices = accessors.add(indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  return primitive;
}

}  // namespace quorum
