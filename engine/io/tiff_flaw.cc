#include "engine/io/tiff_flaw.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace quorum {
namespace {

/// The file in memory, and where libtiff stands in it.
struct Source {
  std::string_view bytes;
  toff_t position = 0;
  bool warned = false;  ///< of codes that are none, by the decoder of JPEG within
};

Source& source_of(thandle_t handle) { return *static_cast<Source*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t count) {
  Source& source = source_of(handle);
  if (source.position >= source.bytes.size()) return 0;
  const std::size_t got = std::min<std::size_t>(static_cast<std::size_t>(count), source.bytes.size() - source.position);
  std::memcpy(to, source.bytes.data() + source.position, got);
  source.position += got;
  return static_cast<tmsize_t>(got);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int from) {
  Source& source = source_of(handle);
  source.position = offset + (from == SEEK_CUR ? source.position : from == SEEK_END ? source.bytes.size() : 0);
  return source.position;
}

int close(thandle_t) { return 0; }

toff_t size_of(thandle_t handle) { return source_of(handle).bytes.size(); }

/// Lets libtiff read the bytes where they are.
int map(thandle_t handle, void** base, toff_t* size) {
  const std::string_view bytes = source_of(handle).bytes;
  *base = const_cast<char*>(bytes.data());
  *size = bytes.size();
  return 1;
}

void unmap(thandle_t, void*, toff_t) {}

/// What libtiff says goes nowhere; failures are also results of its functions.
int drop(TIFF*, void*, const char*, const char*, va_list) { return 1; }

int take_warning(TIFF*, void* source, const char*, const char* format, va_list values) {
  char text[256] = {};
  std::vsnprintf(text, sizeof(text), format, values);
  for (const char* damage : {"premature end", "Premature end", "bad Huffman", "bad arithmetic"})
    if (std::strstr(text, damage) != nullptr) static_cast<Source*>(source)->warned = true;
  return 1;
}

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff open(Source& source) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), drop, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), take_warning, &source);
  return {TIFFClientOpenExt("photograph", "r", &source, read_bytes, write_nothing, seek, close, size_of, map, unmap,
                            options.get()),
          &TIFFClose};
}

}  // namespace

std::optional<TiffFlaw> find_tiff_flaw(std::string_view bytes) {
  if (!bytes.starts_with("II") && !bytes.starts_with("MM")) return std::nullopt;
  Source source{bytes};
  const Tiff tiff = open(source);
  if (!tiff) return std::nullopt;
  std::uint32_t height = 0;
  std::uint16_t compression = COMPRESSION_NONE;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_COMPRESSION, &compression);
  const bool tiled = TIFFIsTiled(tiff.get()) != 0;
  std::uint32_t rows = 0;  // of a strip or tile
  std::uint32_t width = 0;
  std::uint32_t tile_width = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  if (tiled) TIFFGetField(tiff.get(), TIFFTAG_TILEWIDTH, &tile_width);
  tiled ? TIFFGetField(tiff.get(), TIFFTAG_TILELENGTH, &rows)
        : TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_ROWSPERSTRIP, &rows);
  rows = std::clamp<std::uint32_t>(rows, 1, std::max(height, 1U));
  if (height == 0 || width == 0 || (tiled && tile_width == 0) || TIFFIsCODECConfigured(compression) == 0)
    return std::nullopt;
  const tmsize_t size = tiled ? TIFFTileSize(tiff.get()) : TIFFStripSize(tiff.get());
  const std::unique_ptr<void, decltype(&std::free)> buffer(
      size > 0 ? std::malloc(static_cast<std::size_t>(size)) : nullptr, &std::free);
  if (!buffer) return std::nullopt;
  const std::uint32_t pieces = tiled ? TIFFNumberOfTiles(tiff.get()) : TIFFNumberOfStrips(tiff.get());
  const std::uint32_t in_a_row = tiled ? (width + tile_width - 1) / tile_width : 1;
  const std::uint32_t in_a_plane = in_a_row * ((height + rows - 1) / rows);
  for (std::uint32_t piece = 0; piece < pieces; ++piece) {
    const tmsize_t got = tiled ? TIFFReadEncodedTile(tiff.get(), piece, buffer.get(), size)
                               : TIFFReadEncodedStrip(tiff.get(), piece, buffer.get(), size);
    if (got < 0 || source.warned)
      return TiffFlaw{static_cast<int>(piece % in_a_plane / in_a_row * rows), static_cast<int>(height)};
  }
  return std::nullopt;
}

}  // namespace quorum
