// The header of a PLY file: its format, and elements with their properties.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace quorum {

/// A scalar type of PLY under its two names; low and high bound the integers.
struct PlyType {
  std::string_view name;
  std::string_view sized_name;
  std::size_t size = 0;
  bool is_integer = false;
  double low = 0;
  double high = 0;
};

inline constexpr std::array<PlyType, 8> kPlyTypes = {{{"char", "int8", 1, true, -128, 127},
                                                      {"uchar", "uint8", 1, true, 0, 255},
                                                      {"short", "int16", 2, true, -32768, 32767},
                                                      {"ushort", "uint16", 2, true, 0, 65535},
                                                      {"int", "int32", 4, true, -2147483648.0, 2147483647.0},
                                                      {"uint", "uint32", 4, true, 0, 4294967295.0},
                                                      {"float", "float32", 4},
                                                      {"double", "float64", 8}}};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  ///< of a list; null for a scalar
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of a property, or -1.
  [[nodiscard]] int find(std::string_view property) const {
    const auto place = std::ranges::find(properties, property, &PlyProperty::name);
    return place != properties.end() ? static_cast<int>(place - properties.begin()) : -1;
  }
};

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  std::optional<PlyFormat> format;
  std::vector<PlyElement> elements;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< to be added to positions: "comment offset x y z"
  std::size_t size = 0;                              ///< bytes
  int lines = 0;

  [[nodiscard]] const PlyElement* find(std::string_view element) const {
    const auto place = std::ranges::find(elements, element, &PlyElement::name);
    return place != elements.end() ? &*place : nullptr;
  }
};

/// Parses the header at the start of the file's bytes. Fails (kInput), naming file and line, if it is malformed, names
/// an element or property twice, has rows without properties, or vertices without x y z.
Expected<PlyHeader> read_ply_header(const std::filesystem::path& path, std::string_view bytes);

}  // namespace quorum
