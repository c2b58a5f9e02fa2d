#include "engine/pipeline/surface_part.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <string_view>

#include "engine/io/byte_reader.h"
#include "engine/io/file.h"

namespace quorum {
namespace {

constexpr std::string_view kFormat = "quorum surface part 1\n";
constexpr std::uint64_t kMostRecord = 1 << 20;  // bytes

void add_number(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

template <typename Value>
void add_values(std::string& bytes, const std::vector<Value>& values) {
  add_number(bytes, values.size());
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

template <typename Value>
void next_values(ByteReader& reader, std::vector<Value>& values) {
  const std::uint64_t count = reader.next_count(sizeof(Value));
  const std::string_view bytes = reader.next_bytes(count * sizeof(Value));
  values.resize(bytes.size() / sizeof(Value));
  if (!bytes.empty()) std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
}

/// Whether the parts of the surface belong together, so that nothing reaches past an end.
bool is_sound(const MeasuredSurface& surface) {
  const std::size_t blocks = surface.indices.size();
  if (surface.signs.size() != blocks || surface.first_vertex.size() != blocks) return false;
  if (!surface.weights.empty() && surface.weights.size() != blocks * kBlockVoxels) return false;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t before = i == 0 ? 0 : surface.first_vertex[i - 1];
    if (surface.first_vertex[i] < before || surface.first_vertex[i] > surface.vertices.size()) return false;
    if (i > 0 && surface.indices[i] <= surface.indices[i - 1]) return false;
  }
  return true;
}

}  // namespace

Expected<void> write_surface_part(const std::filesystem::path& path, const SurfacePart& part) {
  const MeasuredSurface& surface = part.volume.surface;
  std::string bytes(kFormat);
  bytes.reserve(4096 + part.record.size() + surface.indices.size() * (sizeof(BlockSigns) + 12) +
                surface.vertices.size() * sizeof(Vertex) + surface.weights.size() * 2 +
                part.volume.empty.size() * sizeof(BlockBits));
  add_number(bytes, part.record.size());
  bytes += part.record;
  for (const std::uint64_t number :
       {part.blocks, part.block_views, part.slabs, std::uint64_t{part.volume.views_with_background}})
    add_number(bytes, number);
  add_values(bytes, surface.indices);
  add_values(bytes, surface.signs);
  add_values(bytes, surface.first_vertex);
  add_values(bytes, surface.vertices);
  add_values(bytes, surface.weights);
  add_values(bytes, part.volume.empty);
  return write_file(path, bytes);
}

std::string read_surface_record(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(kFormat.size() + sizeof(std::uint64_t), '\0');
  if (!file.read(begin.data(), static_cast<std::streamsize>(begin.size())) || !begin.starts_with(kFormat)) return "";
  const auto size = ByteReader(std::string_view(begin).substr(kFormat.size())).next<std::uint64_t>();
  if (size > kMostRecord) return "";
  std::string record(size, '\0');
  return file.read(record.data(), static_cast<std::streamsize>(size)) ? record : "";
}

Expected<SurfacePart> read_surface_part(const std::filesystem::path& path) {
  QUORUM_ASSIGN(const std::string bytes, read_file(path));
  const auto broken = [&path] {
    return failure(ErrorKind::kInput,
                   fmt::format("{}: is no part of a surface, or not whole; remove it and run its shard of `quorum "
                               "fuse` again",
                               path.string()));
  };
  if (!bytes.starts_with(kFormat)) return broken();
  ByteReader reader(std::string_view(bytes).substr(kFormat.size()));
  SurfacePart part;
  part.record = reader.next_bytes(reader.next_count(1));
  part.blocks = reader.next<std::uint64_t>();
  part.block_views = reader.next<std::uint64_t>();
  part.slabs = reader.next<std::uint64_t>();
  part.volume.views_with_background = reader.next<std::uint64_t>();
  MeasuredSurface& surface = part.volume.surface;
  next_values(reader, surface.indices);
  next_values(reader, surface.signs);
  next_values(reader, surface.first_vertex);
  next_values(reader, surface.vertices);
  next_values(reader, surface.weights);
  next_values(reader, part.volume.empty);
  if (reader.failed() || reader.left() > 0 || !is_sound(surface)) return broken();
  return part;
}

}  // namespace quorum
