#include "engine/io/prior_maps.h"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

namespace quorum {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(Eigen::Vector3f) == 3 * sizeof(float));

template <typename Value>
std::string npy_of(const Grid<Value>& map) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kFixed = 10;  // before the text: magic, version, length of the text
  std::string text = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}{}), }}", map.height,
                                 map.width, sizeof(Value) > sizeof(float) ? ", 3" : "");
  text.resize((kFixed + text.size() + kAlignment) / kAlignment * kAlignment - kFixed, ' ');
  text.back() = '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(text.size() % 256);
  bytes += static_cast<char>(text.size() / 256);
  bytes += text;
  return bytes.append(reinterpret_cast<const char*>(map.values.data()), map.values.size() * sizeof(Value));
}

}  // namespace

Expected<std::string> write_prior_maps(OutputFolder& output, const std::string& name, const PriorMaps& maps) {
  constexpr float kThousandths = 1000;
  std::string members;
  const auto write = [&](const std::string& kind, const std::string& folder, const auto& map) -> Expected<void> {
    const std::string file = folder + "/" + name + ".npy";
    members += fmt::format(", \"{}_file_path\": {}", kind, nlohmann::json(file).dump());
    return output.write(file, npy_of(map));
  };
  Grid<float> depth = maps.depth;
  for (float& value : depth.values) value *= kThousandths;
  QUORUM_TRY(write("depth", "depths", depth));
  QUORUM_TRY(write("normal", "normals", maps.normal));
  if (maps.certainty) QUORUM_TRY(write("certainty", "certainties", *maps.certainty));
  return members;
}

}  // namespace quorum
