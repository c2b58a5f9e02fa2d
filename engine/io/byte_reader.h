// Walks over the bytes of a binary file, and never past their end.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace quorum {

static_assert(std::endian::native == std::endian::little, "files of little-endian numbers are read as they are");

/// Little-endian numbers and strings, one after the other. Reading past the end gives zeros and empty strings, and
/// failed() from then on.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  requires std::is_arithmetic_v<T> T next() {
    T value{};
    if (failed_ || bytes_.size() - position_ < sizeof(T)) {
      failed_ = true;
      return value;
    }
    std::memcpy(&value, bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  /// The characters before the next zero byte, which is passed over.
  std::string next_string() {
    const std::size_t end = failed_ ? std::string_view::npos : bytes_.find('\0', position_);
    if (end == std::string_view::npos) {
      failed_ = true;
      return {};
    }
    std::string text(bytes_.substr(position_, end - position_));
    position_ = end + 1;
    return text;
  }

  /// So many bytes as they are.
  std::string_view next_bytes(std::uint64_t count) {
    if (failed_ || left() < count) {
      failed_ = true;
      return {};
    }
    position_ += count;
    return bytes_.substr(position_ - count, count);
  }

  /// A 64-bit count of records of at least record_bytes each; fails, with 0, if so many can't follow.
  std::uint64_t next_count(std::size_t record_bytes) {
    const auto count = next<std::uint64_t>();
    if (count <= left() / record_bytes) return count;
    failed_ = true;
    return 0;
  }

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - position_; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
  bool failed_ = false;
};

}  // namespace quorum
