// Parts of a glTF model, for engine/io/glb.cc and its reader.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "engine/mesh/mesh.h"

namespace quorum {

/// Levels of sRGB (IEC 61966-2-1) as linear light, 65535 = white, as glTF wants the colors of vertices. No level lies
/// within 1e-4 of the middle of two numbers, so that every libm gives these.
std::array<std::uint16_t, 256> linear_levels();

/// Fills the one buffer of a model, an accessor with a view of its own at a time.
class Accessors {
 public:
  explicit Accessors(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

  /// Bytes of any number, as a view of the buffer; its index.
  int add_bytes(const void* bytes, std::size_t size, int target) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    data.resize((data.size() + size + 3) / 4 * 4);
    std::memcpy(data.data() + view.byteOffset, bytes, size);
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  /// values: count elements of a type and component that the constants of tinygltf name; every size is a multiple of 4.
  template <typename T>
  int add(const std::vector<T>& values, int component, int type, int target) {
    tinygltf::Accessor accessor;
    accessor.bufferView = add_bytes(values.data(), values.size() * sizeof(T), target);
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = values.size();
    accessor.normalized = component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

 private:
  tinygltf::Model& model_;
};

/// Points or triangles with POSITION, NORMAL, COLOR_0 or, if there are coordinates, TEXCOORD_0 in its place,
/// _CONFIDENCE and indices. mesh: not empty. coordinates: none, or one a vertex. material: of the model.
tinygltf::Primitive make_primitive(tinygltf::Model& model, Accessors& accessors, const Mesh& mesh,
                                   std::span<const Eigen::Vector2f> coordinates, int material);

}  // namespace quorum
