#include "engine/io/glb.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>
#include <vector>

#include "engine/core/version.h"
#include "engine/io/file.h"
#include "engine/io/glb_primitive.h"
#include "engine/io/write_image.h"

namespace quorum {
namespace {

/// One mesh of no primitives yet, in one node with the offset.
tinygltf::Model make_model(const Eigen::Vector3d& offset) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = fmt::format("Quorum {}", version());
  model.extensionsUsed = {"KHR_materials_unlit"};
  model.meshes.resize(1);
  model.nodes.resize(1);
  model.nodes[0].mesh = 0;
  if (!offset.isZero(0.0)) model.nodes[0].translation = {offset.x(), offset.y(), offset.z()};
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  model.defaultScene = 0;
  return model;
}

/// Unlit and seen from both sides; its index. texture: of the model, or -1.
int add_material(tinygltf::Model& model, const std::string& name, int texture) {
  tinygltf::Material material;
  material.name = name;
  material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.baseColorTexture.index = texture;
  material.doubleSided = true;
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

int add_texture(tinygltf::Model& model, Accessors& accessors, const std::string& bytes, std::string_view ending) {
  tinygltf::Image image;
  image.bufferView = accessors.add_bytes(bytes.data(), bytes.size(), 0);
  image.mimeType = ending == ".png" ? "image/png" : "image/jpeg";
  model.images.push_back(std::move(image));
  tinygltf::Texture texture;
  texture.source = static_cast<int>(model.images.size()) - 1;
  texture.sampler = 0;
  model.textures.push_back(std::move(texture));
  return static_cast<int>(model.textures.size()) - 1;
}

/// Charts must not meet what lies on the other side of a page, nor, in smaller pictures of it, their neighbors.
void add_sampler(tinygltf::Model& model) {
  tinygltf::Sampler sampler;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  model.samplers.push_back(std::move(sampler));
}

/// Triangles of one page, or without, as a mesh of their own.
Mesh part_of(const TexturedMesh& mesh, std::size_t page) {
  Mesh part;
  const std::uint32_t first = mesh.first_vertices[page];
  part.vertices.assign(mesh.mesh.vertices.begin() + first, mesh.mesh.vertices.begin() + mesh.first_vertices[page + 1]);
  part.triangles.assign(mesh.mesh.triangles.begin() + mesh.first_triangles[page],
                        mesh.mesh.triangles.begin() + mesh.first_triangles[page + 1]);
  for (auto& triangle : part.triangles)
    for (std::uint32_t& corner : triangle) corner -= first;
  return part;
}

/// pages: bytes of files.
Expected<void> check_size(const std::filesystem::path& path, const Mesh& mesh, std::uint64_t page_bytes) {
  constexpr std::uint64_t kMost = std::uint64_t{4} << 30;
  constexpr std::uint64_t kVertexSize = 36;
  if (mesh.vertices.empty())
    return failure(ErrorKind::kInput, fmt::format("{}: glTF holds no empty mesh; nothing was written", path.string()));
  if (mesh.vertices.size() * kVertexSize + mesh.triangles.size() * 12 + page_bytes + (1 << 16) > kMost)
    return failure(ErrorKind::kInput,
                   fmt::format("{}: {} vertices and {} triangles are more than a GLB file holds; simplify the mesh",
                               path.string(), mesh.vertices.size(), mesh.triangles.size()));
  return {};
}

Expected<void> write_model(const std::filesystem::path& path, const tinygltf::Model& model) {
  std::ostringstream stream;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true))
    return failure(ErrorKind::kInput, fmt::format("{}: could not be made", path.string()));
  return write_file(path, stream.view());
}

}  // namespace

Expected<std::string> encode_page(const ColorImage& page, std::string_view ending) {
  constexpr int kQuality = 95;
  return ending == ".png" ? encode_png(page) : encode_jpeg(page, kQuality);
}

Expected<void> write_glb(const std::filesystem::path& path, const Mesh& mesh) {
  QUORUM_TRY(check_size(path, mesh, 0));
  tinygltf::Model model = make_model(mesh.offset);
  Accessors accessors(model);
  const int material = add_material(model, "", -1);
  model.meshes[0].primitives.push_back(make_primitive(model, accessors, mesh, {}, material));
  return write_model(path, model);
}

Expected<void> write_glb(const std::filesystem::path& path, const TexturedMesh& mesh, std::string_view page_ending) {
  QUORUM_TRY(check_size(path, mesh.mesh, 0));
  tinygltf::Model model = make_model(mesh.mesh.offset);
  Accessors accessors(model);
  add_sampler(model);
  std::uint64_t page_bytes = 0;
  for (std::size_t page = 0; page < mesh.pages.size(); ++page) {
    const auto bytes = encode_page(mesh.pages[page], page_ending);
    if (!bytes) return std::unexpected(bytes.error().within(path.string()));
    page_bytes += bytes->size();
    QUORUM_TRY(check_size(path, mesh.mesh, page_bytes));
    const int texture = add_texture(model, accessors, *bytes, page_ending);
    const int material = add_material(model, fmt::format("page {}", page + 1), texture);
    const std::span coordinates =
        std::span(mesh.coordinates)
            .subspan(mesh.first_vertices[page], mesh.first_vertices[page + 1] - mesh.first_vertices[page]);
    model.meshes[0].primitives.push_back(make_primitive(model, accessors, part_of(mesh, page), coordinates, material));
  }
  if (mesh.unseen_triangles() > 0)
    model.meshes[0].primitives.push_back(
        make_primitive(model, accessors, part_of(mesh, mesh.pages.size()), {}, add_material(model, "unseen", -1)));
  return write_model(path, model);
}

}  // namespace quorum
