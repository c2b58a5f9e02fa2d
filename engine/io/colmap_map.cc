#include "engine/io/colmap_map.h"

#include <fmt/format.h>

#include <array>
#include <bit>

#include "engine/io/file.h"

namespace quorum {
namespace {

static_assert(std::endian::native == std::endian::little, "floats are written as they stand in memory");

void append_float(std::string& bytes, float value) {
  const auto word = std::bit_cast<std::array<char, sizeof(float)>>(value);
  bytes.append(word.data(), word.size());
}

}  // namespace

Expected<void> write_colmap_map(const std::filesystem::path& path, const Grid<float>& map) {
  std::string bytes = fmt::format("{}&{}&1&", map.width, map.height);
  for (const float value : map.values) append_float(bytes, value);
  return write_file(path, bytes);
}

Expected<void> write_colmap_map(const std::filesystem::path& path, const Grid<Eigen::Vector3f>& map) {
  std::string bytes = fmt::format("{}&{}&3&", map.width, map.height);
  for (int channel = 0; channel < 3; ++channel)
    for (const Eigen::Vector3f& value : map.values) append_float(bytes, value(channel));
  return write_file(path, bytes);
}

}  // namespace quorum
