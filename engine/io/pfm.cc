#include "engine/io/pfm.h"

#include <fmt/format.h>

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

Expected<Header> read_header(const std::filesystem::path& path, std::string_view bytes) {
  LineReader lines(bytes);
  const std::string_view kind = lines.next().value_or("");
  if (kind == "PF") return failure_at_line(path, 1, "has three channels (PF), expected one (Pf)");
  if (kind != "Pf")
    return failure_at_line(path, 1, fmt::format("expected Pf, found {}: not a PFM file", quote_token(kind)));

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

}  // namespace

Expected<void> write_pfm(const std::filesystem::path& path, const Grid<float>& map) {
  std::string bytes = fmt::format("Pf\n{} {}\n-1.0\n", map.width, map.height);
  bytes.reserve(bytes.size() + map.values.size() * sizeof(float));
  for (int y = map.height - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(map.row(y)), static_cast<std::size_t>(map.width) * sizeof(float));
  return write_file(path, bytes);
}

Expected<Grid<float>> read_pfm(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return std::unexpected(bytes.error());
  const auto header = read_header(path, *bytes);
  if (!header) return std::unexpected(header.error());

  const std::uint64_t expected = std::uint64_t{4} * static_cast<std::uint64_t>(header->width) * header->height;
  const std::uint64_t found = bytes->size() - header->size;
  if (found != expected)
    return failure_at_line(path, 2,
                           fmt::format("{} x {} values take {} bytes after the header, found {}", header->width,
                                       header->height, expected, found));

  Grid<float> map(header->width, header->height);
  const std::size_t row_size = static_cast<std::size_t>(map.width) * sizeof(float);
  for (int y = 0; y < map.height && row_size > 0; ++y)
    std::memcpy(map.row(map.height - 1 - y), bytes->data() + header->size + row_size * y, row_size);
  if (header->big_endian)
    for (float& value : map.values) value = std::bit_cast<float>(std::byteswap(std::bit_cast<std::uint32_t>(value)));
  return map;
}

}  // namespace quorum
