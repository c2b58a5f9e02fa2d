#include "engine/io/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/io/file.h"
#include "engine/io/ply_header.h"
#include "engine/io/ply_values.h"
#include "engine/io/text.h"
#include "engine/scene/local_frame.h"

namespace quorum {
namespace {

static_assert(std::endian::native == std::endian::little, "values are copied into little-endian files as they are");

/// The values of one row, per property: one for a scalar, any number for a list.
using Row = std::vector<std::vector<double>>;

void read_row(PlyValues& values, const PlyElement& element, Row& row) {
  row.resize(element.properties.size());
  values.begin_row();
  for (std::size_t i = 0; i < row.size() && values.ok(); ++i) {
    const PlyProperty& property = element.properties[i];
    row[i].clear();
    const double count = property.count_type != nullptr ? values.next(*property.count_type) : 1.0;
    if (count < 0) values.fail(fmt::format("list {} has the length {}", quote_token(property.name), count));
    for (double n = 0; n < count && values.ok(); ++n) row[i].push_back(values.next(*property.type));
  }
  if (values.ok()) values.end_row();
}

/// Calls use(row) for each row of an element until something fails.
template <typename Use>
void for_each_row(PlyValues& values, const PlyElement& element, Use use) {
  Row row;
  for (std::uint64_t i = 0; i < element.count && values.ok(); ++i) {
    read_row(values, element, row);
    if (values.ok()) use(row);
  }
}

/// Three vertex properties that belong together, by their names.
struct Columns {
  std::array<int, 3> index = {-1, -1, -1};

  Columns(const PlyElement& element, const std::array<const char*, 3>& names) {
    std::ranges::transform(names, index.begin(), [&element](const char* name) { return element.find(name); });
  }
  [[nodiscard]] bool complete() const { return std::ranges::min(index) >= 0; }
  [[nodiscard]] Eigen::Vector3d of(const Row& row) const {
    return {row[index[0]][0], row[index[1]][0], row[index[2]][0]};
  }
};

/// positions: of the vertices, as the file gives them.
void read_vertices(PlyValues& values, const PlyElement& element, std::vector<Vertex>& vertices,
                   std::vector<Eigen::Vector3d>& positions) {
  const Columns position(element, {"x", "y", "z"});
  const Columns normal(element, {"nx", "ny", "nz"});
  const Columns color(element, {"red", "green", "blue"});
  const int confidence = element.find(element.find("confidence") >= 0 ? "confidence" : "quality");
  const auto to_byte = [&element](int column, const Row& row) {
    const double scale = element.properties[column].type->is_integer ? 1.0 : 255.0;
    const double value = row[column][0] * scale;
    return value > 0 ? static_cast<std::uint32_t>(std::min(value, 255.0) + 0.5) : 0U;
  };
  vertices.reserve(element.count);
  positions.reserve(element.count);
  for_each_row(values, element, [&](const Row& row) {
    Vertex vertex;
    positions.push_back(position.of(row));
    if (!positions.back().cast<float>().allFinite())
      values.fail(fmt::format("the position of vertex {} is not finite", vertices.size()));
    if (normal.complete()) vertex.normal = normal.of(row).cast<float>();
    if (!vertex.normal.allFinite()) vertex.normal.setZero();
    if (color.complete())
      vertex.color = make_rgb(to_byte(color.index[0], row), to_byte(color.index[1], row), to_byte(color.index[2], row));
    if (confidence >= 0) vertex.confidence = static_cast<float>(row[confidence][0]);
    if (!std::isfinite(vertex.confidence)) vertex.confidence = 0.0F;
    vertices.push_back(vertex);
  });
}

void read_faces(PlyValues& values, const PlyElement& element, std::uint64_t vertex_count,
                std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const int column = element.find(element.find("vertex_indices") >= 0 ? "vertex_indices" : "vertex_index");
  if (column < 0 || element.properties[column].count_type == nullptr) {
    if (element.count > 0) values.fail("element face has no list vertex_indices or vertex_index");
    return;
  }
  std::uint64_t face = 0;
  triangles.reserve(element.count);
  for_each_row(values, element, [&](const Row& row) {
    const std::vector<double>& corners = row[column];
    if (corners.size() < 3)
      values.fail(fmt::format("face {} has {} corners, expected 3 or more", face, corners.size()));
    for (const double corner : corners)
      if (!(corner >= 0 && corner < static_cast<double>(vertex_count) && corner == std::floor(corner)))
        values.fail(fmt::format("face {} names vertex {}, but there are {} vertices", face, corner, vertex_count));
    if (!values.ok()) return;
    const auto index = [&corners](std::size_t i) { return static_cast<std::uint32_t>(corners[i]); };
    for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({index(0), index(i - 1), index(i)});
    ++face;
  });
}

/// The offset that a mesh with these positions had best.
Eigen::Vector3d offset_of(const std::vector<Eigen::Vector3d>& positions) {
  if (positions.empty()) return Eigen::Vector3d::Zero();
  Eigen::Vector3d low = positions.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& position : positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  return far_offset((low + high) / 2.0, (high - low).norm() / 2.0);
}

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void append(std::string& bytes, const Eigen::Vector3f& vector) {
  for (const float value : vector) append(bytes, value);
}

}  // namespace

Expected<std::string> encode_ply(const Mesh& mesh, PlyFrame frame) {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (mesh.vertices.size() > kMost || mesh.triangles.size() > kMost)
    return failure(ErrorKind::kInput,
                   fmt::format("{} vertices and {} triangles are more than PLY can index; choose larger voxels",
                               mesh.vertices.size(), mesh.triangles.size()));
  const bool is_far = !mesh.offset.isZero(0.0);
  const bool in_double = is_far && frame == PlyFrame::kWorld;
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  if (is_far)
    bytes += fmt::format("comment {} {} {} {}\n", in_double ? "taken off while this was made:" : "offset",
                         mesh.offset.x(), mesh.offset.y(), mesh.offset.z());
  bytes += fmt::format("element vertex {}\n", mesh.vertices.size());
  for (const char* name : {"x", "y", "z"})
    bytes += fmt::format("property {} {}\n", in_double ? "double" : "float", name);
  for (const char* name : {"nx", "ny", "nz"}) bytes += fmt::format("property float {}\n", name);
  for (const char* name : {"red", "green", "blue"}) bytes += fmt::format("property uchar {}\n", name);
  for (const char* name : {"confidence", "quality"}) bytes += fmt::format("property float {}\n", name);
  if (!mesh.triangles.empty())
    bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  bytes += "end_header\n";

  const std::size_t vertex_size = (in_double ? 11 : 8) * sizeof(float) + 3;
  constexpr std::size_t kFaceSize = 1 + 3 * sizeof(std::int32_t);
  bytes.reserve(bytes.size() + mesh.vertices.size() * vertex_size + mesh.triangles.size() * kFaceSize);
  for (const Vertex& vertex : mesh.vertices) {
    if (in_double)
      for (const double value : mesh.offset + vertex.position.cast<double>()) append(bytes, value);
    else
      append(bytes, vertex.position);
    append(bytes, vertex.normal);
    for (const std::uint32_t level : {red_of(vertex.color), green_of(vertex.color), blue_of(vertex.color)})
      append(bytes, static_cast<std::uint8_t>(level));
    append(bytes, vertex.confidence);
    append(bytes, vertex.confidence);
  }
  for (const auto& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : triangle) append(bytes, corner);
  }
  return bytes;
}

Expected<void> write_ply(const std::filesystem::path& path, const Mesh& mesh, PlyFrame frame) {
  const auto bytes = encode_ply(mesh, frame);
  if (!bytes) return std::unexpected(bytes.error().within(path.string()));
  return write_file(path, *bytes);
}

Expected<Mesh> read_ply(const std::filesystem::path& path, const std::optional<Eigen::Vector3d>& offset) {
  QUORUM_ASSIGN(const auto bytes, read_file(path));
  QUORUM_ASSIGN(const auto header, read_ply_header(path, bytes));

  Mesh mesh;
  std::vector<Eigen::Vector3d> positions;
  const std::unique_ptr<PlyValues> values = make_ply_values(path, bytes, header);
  const std::uint64_t vertex_count = header.find("vertex")->count;
  for (const PlyElement& element : header.elements) {
    if (!values->may_hold(element))
      values->fail(fmt::format("{} rows of element {} do not fit into the rest of the file", element.count,
                               quote_token(element.name)));
    else if (element.name == "vertex")
      read_vertices(*values, element, mesh.vertices, positions);
    else if (element.name == "face")
      read_faces(*values, element, vertex_count, mesh.triangles);
    else
      for_each_row(*values, element, [](const Row&) {});
    if (!values->ok()) return std::unexpected(values->error());
  }
  values->end_file();
  if (!values->ok()) return std::unexpected(values->error());
  const Eigen::Vector3d found = offset ? *offset - header.offset : offset_of(positions);
  for (std::size_t i = 0; i < positions.size(); ++i) mesh.vertices[i].position = (positions[i] - found).cast<float>();
  mesh.offset = header.offset + found;
  return mesh;
}

}  // namespace quorum
