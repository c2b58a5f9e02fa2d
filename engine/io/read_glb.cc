// Reads the GLB files that engine/io/glb.cc writes; declared in engine/io/glb.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/io/file.h"
#include "engine/io/glb.h"
#include "engine/io/glb_primitive.h"
#include "engine/io/image_file.h"

namespace quorum {
namespace {

/// Leaves an image where it is: tinygltf does not look whether its bytes lie inside of the file.
bool leave_image(tinygltf::Image* /*image*/, int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                 int /*width*/, int /*height*/, const unsigned char* /*bytes*/, int /*size*/, void* /*user*/) {
  return true;
}

/// The arrays of a model. The first one that is not as it should be is kept for done().
class ModelReader {
 public:
  ModelReader(const std::filesystem::path& path, const tinygltf::Model& model) : path_(path), model_(model) {}

  /// Elements of `parts` values of type T each; none after a failure.
  template <typename T>
  std::vector<T> values(int accessor_index, int component, int type, int parts) {
    std::vector<T> read;
    const tinygltf::Accessor* accessor = at(model_.accessors, accessor_index);
    if (accessor == nullptr || accessor->componentType != component || accessor->type != type ||
        accessor->sparse.isSparse)
      return fail<T>();
    const auto bytes = bytes_of(accessor->bufferView);
    if (accessor->byteOffset != 0 || accessor->count > bytes.size() / (sizeof(T) * static_cast<std::size_t>(parts)))
      return fail<T>();
    read.resize(accessor->count * static_cast<std::size_t>(parts));
    if (!read.empty()) std::memcpy(read.data(), bytes.data(), read.size() * sizeof(T));
    return read;
  }

  /// What a view of the buffer shows; nothing after a failure.
  std::span<const unsigned char> bytes_of(int view_index) {
    const tinygltf::BufferView* view = at(model_.bufferViews, view_index);
    const std::span<const unsigned char> data = model_.buffers[0].data;
    if (view == nullptr || view->buffer != 0 || view->byteStride != 0 || view->byteOffset > data.size() ||
        view->byteLength > data.size() - view->byteOffset) {
      fail<float>();
      return {};
    }
    return data.subspan(view->byteOffset, view->byteLength);
  }

  template <typename T>
  std::vector<T> attribute(const tinygltf::Primitive& primitive, const char* name, int component, int type, int parts) {
    const auto place = primitive.attributes.find(name);
    return place != primitive.attributes.end() ? values<T>(place->second, component, type, parts) : fail<T>();
  }

  template <typename T>
  std::vector<T> fail() {
    failed_ = true;
    return {};
  }

  /// Null if there is none of this index.
  template <typename T>
  static const T* at(const std::vector<T>& all, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < all.size() ? &all[static_cast<std::size_t>(index)] : nullptr;
  }

  [[nodiscard]] Expected<void> done() const {
    if (!failed_) return {};
    return failure(ErrorKind::kInput,
                   fmt::format("{}: is not as Quorum writes it; give a GLB file of quorum texture or "
                               "quorum simplify, or a .ply",
                               path_.string()));
  }

 private:
  const std::filesystem::path& path_;
  const tinygltf::Model& model_;
  bool failed_ = false;
};

std::uint32_t level_of(std::uint16_t light) {
  static const std::array<std::uint16_t, 256> kLinear = linear_levels();
  return static_cast<std::uint32_t>(
      std::min<std::ptrdiff_t>(255, std::ranges::lower_bound(kLinear, light) - kLinear.begin()));
}

/// Appends a primitive's vertices and triangles. shift: added to positions in double.
void add_primitive(ModelReader& reader, const tinygltf::Primitive& primitive, const Eigen::Vector3d& shift,
                   TexturedMesh& mesh) {
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
  const auto first = static_cast<std::uint32_t>(mesh.mesh.vertices.size());
  const auto positions = reader.attribute<float>(primitive, "POSITION", kFloat, TINYGLTF_TYPE_VEC3, 3);
  const auto normals = reader.attribute<float>(primitive, "NORMAL", kFloat, TINYGLTF_TYPE_VEC3, 3);
  const auto confidences = reader.attribute<float>(primitive, "_CONFIDENCE", kFloat, TINYGLTF_TYPE_SCALAR, 1);
  const std::size_t count = confidences.size();
  const bool has_colors = primitive.attributes.contains("COLOR_0");
  std::vector<std::uint16_t> colors(4 * count);
  std::vector<float> places(2 * count);
  if (has_colors)
    colors = reader.attribute<std::uint16_t>(primitive, "COLOR_0", TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                                             TINYGLTF_TYPE_VEC4, 4);
  else
    places = reader.attribute<float>(primitive, "TEXCOORD_0", kFloat, TINYGLTF_TYPE_VEC2, 2);
  if (positions.size() != 3 * count || normals.size() != 3 * count || colors.size() != 4 * count ||
      places.size() != 2 * count) {
    reader.fail<float>();
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    Vertex vertex;
    const Eigen::Vector3f position(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    vertex.position = (position.cast<double>() + shift).cast<float>();
    vertex.normal = Eigen::Vector3f(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    vertex.confidence = confidences[i];
    if (has_colors)
      vertex.color = make_rgb(level_of(colors[4 * i]), level_of(colors[4 * i + 1]), level_of(colors[4 * i + 2]));
    const Eigen::Vector2f place(places[2 * i], places[2 * i + 1]);
    const bool is_sound = vertex.position.allFinite() && vertex.normal.allFinite() && vertex.confidence >= 0 &&
                          std::isfinite(vertex.confidence) && (place.array() >= 0).all() && (place.array() <= 1).all();
    if (!is_sound) reader.fail<float>();
    mesh.mesh.vertices.push_back(vertex);
    mesh.coordinates.push_back(place);
  }
  if (primitive.mode == TINYGLTF_MODE_POINTS) return;
  const auto indices =
      reader.values<std::uint32_t>(primitive.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, 1);
  if (indices.size() % 3 != 0 || std::ranges::any_of(indices, [&](std::uint32_t index) { return index >= count; })) {
    reader.fail<float>();
    return;
  }
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    mesh.mesh.triangles.push_back({first + indices[i], first + indices[i + 1], first + indices[i + 2]});
}

/// The image of a primitive's material; null if it has none.
const tinygltf::Image* image_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const tinygltf::Material* material = ModelReader::at(model.materials, primitive.material);
  if (material == nullptr) return nullptr;
  const tinygltf::Texture* texture =
      ModelReader::at(model.textures, material->pbrMetallicRoughness.baseColorTexture.index);
  return texture != nullptr ? ModelReader::at(model.images, texture->source) : nullptr;
}

Expected<TexturedMesh> to_mesh(const std::filesystem::path& path, const tinygltf::Model& model,
                               const std::optional<Eigen::Vector3d>& offset) {
  ModelReader reader(path, model);
  if (model.meshes.size() != 1 || model.buffers.size() != 1 || model.nodes.size() != 1) reader.fail<float>();
  QUORUM_TRY(reader.done());
  TexturedMesh mesh;
  const std::vector<double>& moved = model.nodes[0].translation;
  const Eigen::Vector3d node =
      moved.size() == 3 ? Eigen::Vector3d(moved[0], moved[1], moved[2]) : Eigen::Vector3d(0, 0, 0);
  mesh.mesh.offset = offset.value_or(node);
  bool textured = true;
  for (const tinygltf::Primitive& primitive : model.meshes[0].primitives) {
    const tinygltf::Image* image = image_of(model, primitive);
    if (image == nullptr) textured = false;
    if (image != nullptr && !textured) reader.fail<float>();  // those without a page come last
    mesh.first_triangles.push_back(static_cast<std::uint32_t>(mesh.mesh.triangles.size()));
    mesh.first_vertices.push_back(static_cast<std::uint32_t>(mesh.mesh.vertices.size()));
    add_primitive(reader, primitive, node - mesh.mesh.offset, mesh);
    QUORUM_TRY(reader.done());
    if (image == nullptr) continue;
    const auto bytes = reader.bytes_of(image->bufferView);
    QUORUM_TRY(reader.done());
    QUORUM_ASSIGN(auto page, decode_image(path, std::string(bytes.begin(), bytes.end())));
    mesh.pages.push_back(std::move(page));
  }
  while (mesh.first_triangles.size() < mesh.pages.size() + 2) {
    mesh.first_triangles.push_back(static_cast<std::uint32_t>(mesh.mesh.triangles.size()));
    mesh.first_vertices.push_back(static_cast<std::uint32_t>(mesh.mesh.vertices.size()));
  }
  if (mesh.first_triangles.size() != mesh.pages.size() + 2) reader.fail<float>();
  QUORUM_TRY(reader.done());
  return mesh;
}

}  // namespace

Expected<TexturedMesh> read_glb(const std::filesystem::path& path, const std::optional<Eigen::Vector3d>& offset) {
  QUORUM_ASSIGN(const auto bytes, read_file(path));
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(leave_image, nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const bool fits = bytes.size() <= std::numeric_limits<unsigned int>::max();
  if (!fits ||
      !loader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<unsigned int>(bytes.size())))
    return failure(ErrorKind::kInput, fmt::format("{}: is no whole GLB file; write it again", path.string()));
  return to_mesh(path, model, offset);
}

}  // namespace quorum
