#include "engine/io/pfm.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "engine/io/file.h"
#include "engine/io/text.h"

namespace quorum {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are copied between memory and file as they are");

struct Header {
  int width = 0;
  int height = 0;
  bool big_endian = false;
  std::size_t size = 0;  ///< bytes
};

/// kind: "Pf" for one channel, "PF" for three.
Expected<Header> read_header(const std::filesystem::path& path, std::string_view bytes, std::string_view kind) {
  LineReader lines(bytes);
  const std::string_view found = lines.next().value_or("");
  if (found != kind && found == "PF") return failure_at_line(path, 1, "has three channels (PF), expected one (Pf)");
  if (found != kind && found == "Pf") return failure_at_line(path, 1, "has one channel (Pf), expected three (PF)");
  if (found != kind)
    return failure_at_line(path, 1, fmt::format("expected {}, found {}: not a PFM file", kind, quote_token(found)));

  Header header;
  const auto size = split_tokens(lines.next().value_or(""));
  const auto width = size.size() == 2 ? parse_number<int>(size[0]) : std::nullopt;
  const auto height = size.size() == 2 ? parse_number<int>(size[1]) : std::nullopt;
  if (!width || !height || *width < 0 || *height < 0) return failure_at_line(path, 2, "expected width and height");
  header.width = *width;
  header.height = *height;

  const auto scales = split_tokens(lines.next().value_or(""));
  const auto scale = scales.size() == 1 ? parse_number<double>(scales[0]) : std::nullopt;
  if (!scale || !std::isfinite(*scale) || *scale == 0)
    return failure_at_line(path, 3, "expected a scale, negative for little-endian and positive for big-endian values");
  header.big_endian = *scale > 0;
  header.size = lines.position();
  return header;
}

template <typename Value>
std::string bytes_of(const char* kind, const Grid<Value>& map) {
  std::string bytes = fmt::format("{}\n{} {}\n-1.0\n", kind, map.width, map.height);
  bytes.reserve(bytes.size() + map.values.size() * sizeof(Value));
  for (int y = map.height - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(map.row(y)), static_cast<std::size_t>(map.width) * sizeof(Value));
  return bytes;
}

template <typename Value>
Expected<Grid<Value>> read_map(const std::filesystem::path& path, std::string_view kind, const Value& zero) {
  QUORUM_ASSIGN(const auto bytes, read_file(path));
  QUORUM_ASSIGN(const auto header, read_header(path, bytes, kind));

  const std::uint64_t expected = sizeof(Value) * static_cast<std::uint64_t>(header.width) * header.height;
  const std::uint64_t found = bytes.size() - header.size;
  if (found != expected)
    return failure_at_line(path, 2,
                           fmt::format("{} x {} values take {} bytes after the header, found {}", header.width,
                                       header.height, expected, found));

  Grid<Value> map(header.width, header.height, zero);
  const std::size_t row_size = static_cast<std::size_t>(map.width) * sizeof(Value);
  for (int y = 0; y < map.height && row_size > 0; ++y) {
    auto* row = reinterpret_cast<unsigned char*>(map.row(map.height - 1 - y));
    std::memcpy(row, bytes.data() + header.size + row_size * static_cast<std::size_t>(y), row_size);
    if (!header.big_endian) continue;
    for (std::size_t word = 0; word < row_size; word += 4) std::reverse(row + word, row + word + 4);
  }
  return map;
}

}  // namespace

std::string pfm_bytes(const Grid<float>& map) { return bytes_of("Pf", map); }

std::string pfm_bytes(const Grid<Eigen::Vector3f>& map) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  return bytes_of("PF", map);
}

Expected<void> write_pfm(const std::filesystem::path& path, const Grid<float>& map) {
  return write_file(path, pfm_bytes(map));
}

Expected<void> write_pfm(const std::filesystem::path& path, const Grid<Eigen::Vector3f>& map) {
  return write_file(path, pfm_bytes(map));
}

Expected<Grid<float>> read_pfm(const std::filesystem::path& path) { return read_map(path, "Pf", 0.0F); }

Expected<Grid<Eigen::Vector3f>> read_pfm_vectors(const std::filesystem::path& path) {
  return read_map<Eigen::Vector3f>(path, "PF", Eigen::Vector3f::Zero());
}

}  // namespace quorum
