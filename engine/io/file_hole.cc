#include "engine/io/file_hole.h"

#include <algorithm>
#include <cstdint>

namespace quorum {
namespace {

constexpr std::size_t kBlock = 4096;        // of file systems
constexpr std::size_t kCopied = 64 * 1024;  // at once, or a multiple of it

/// A number of four bytes; 0 behind the end.
std::uint32_t number_at(std::string_view bytes, std::size_t at, bool little_endian) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t place = at + (little_endian ? 3 - i : i);
    value = value << 8 | (place < bytes.size() ? static_cast<unsigned char>(bytes[place]) : 0U);
  }
  return value;
}

/// The codes of a WebP file, with what stands before them; empty if it is none.
std::string_view codes_of_webp(std::string_view bytes) {
  if (bytes.size() < 12 || !bytes.starts_with("RIFF") || bytes.substr(8, 4) != "WEBP") return {};
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string_view kind = bytes.substr(at, 4);
    const std::size_t size = number_at(bytes, at + 4, true);
    if (kind == "VP8 " || kind == "VP8L") return bytes.substr(0, at + 8 + size);
    at += 8 + size + size % 2;
  }
  return {};
}

/// The same of JPEG 2000: the box jp2c, or a file that is a codestream alone.
std::string_view codes_of_jpeg_2000(std::string_view bytes) {
  if (bytes.starts_with("\xff\x4f\xff\x51")) return bytes;
  if (!bytes.starts_with(std::string_view("\0\0\0\x0cjP  ", 8))) return {};
  for (std::size_t at = 0; at + 8 <= bytes.size();) {
    const std::size_t size = number_at(bytes, at, false);
    if (bytes.substr(at + 4, 4) == "jp2c") return size < 2 ? bytes : bytes.substr(0, at + size);
    if (size < 8) return {};  // to the end, or of 64 bits
    at += size;
  }
  return {};
}

/// Where the zeros begin that stand at the end.
std::size_t begin_of_last_zeros(std::string_view bytes) {
  const std::size_t last = bytes.find_last_not_of('\0');
  return last == std::string_view::npos ? 0 : last + 1;
}

std::optional<std::size_t> find_lost_end(std::string_view bytes) {
  constexpr std::size_t kLeastZeros = 64;
  constexpr std::string_view kEndOfCodestream = "\xff\xd9";  // zeros may follow it
  for (const std::string_view codes : {codes_of_webp(bytes), codes_of_jpeg_2000(bytes)}) {
    const std::size_t begin = begin_of_last_zeros(codes);
    if (codes.size() - begin >= kLeastZeros && !codes.substr(0, begin).ends_with(kEndOfCodestream)) return begin;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> find_hole(std::string_view bytes) {
  for (std::size_t begin = kBlock; begin + kBlock <= bytes.size();) {
    const std::size_t end = std::min(bytes.find_first_not_of('\0', begin), bytes.size());
    const bool is_behind_others = bytes[begin - 1] != '\0';
    const bool is_hole = end == bytes.size() ? begin % kCopied == 0 : end >= begin + kBlock && end % kBlock == 0;
    if (is_behind_others && is_hole) return begin;
    begin = std::max(begin + 1, end) / kBlock * kBlock + kBlock;
  }
  return find_lost_end(bytes);
}

}  // namespace quorum
