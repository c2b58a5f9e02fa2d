#include "engine/io/ply_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/io/text.h"

namespace quorum {
namespace {

static_assert(std::endian::native == std::endian::little, "little-endian values are copied as they are");

/// True if count rows of at least row_size bytes fit into size bytes. The header has refused rows without properties,
/// so row_size is 0 only where count is.
bool fits(std::uint64_t count, std::uint64_t row_size, std::uint64_t size) {
  return count == 0 || count <= size / row_size;
}

/// One row per line.
class AsciiValues : public PlyValues {
 public:
  AsciiValues(const std::filesystem::path& path, std::string_view text, int header_lines)
      : path_(path.string()), text_(text), lines_(text), header_lines_(header_lines) {}

  void begin_row() override {
    const auto line = lines_.next_filled();
    if (!line) fail("the file ends before the last row; it is cut off or its header is wrong");
    rest_ = line.value_or("");
  }

  double next(const PlyType& type) override {
    if (!ok()) return 0;
    const std::string_view token = take_token();
    const auto value = parse_number<double>(token);
    if (token.empty()) fail("the row has too few values");
    if (!value) fail(quote_token(token) + " is not a number");
    if (!ok()) return 0;
    if (type.is_integer && !(*value >= type.low && *value <= type.high && *value == std::floor(*value)))
      fail(fmt::format("{} is not of type {}", quote_token(token), type.name));
    return ok() ? *value : 0;
  }

  void end_row() override {
    if (const std::string_view token = take_token(); !token.empty())
      fail("the row has too many values, from " + quote_token(token));
  }

  void end_file() override {
    if (lines_.next_filled()) fail("there are more lines than the header says");
  }

  // A value takes a digit and a separator; the last one of the file needs none.
  [[nodiscard]] bool may_hold(const PlyElement& element) const override {
    return fits(element.count, 2 * element.properties.size(), text_.size() - lines_.position() + 1);
  }

 protected:
  [[nodiscard]] std::string place() const override {
    return fmt::format("{}:{}", path_, header_lines_ + lines_.number());
  }

 private:
  std::string_view take_token() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kTextSpace), rest_.size()));
    const std::string_view token = rest_.substr(0, rest_.find_first_of(kTextSpace));
    rest_.remove_prefix(token.size());
    return token;
  }

  std::string path_;
  std::string_view text_;
  LineReader lines_;
  std::string_view rest_;  ///< of the row
  int header_lines_;
};

class BinaryValues : public PlyValues {
 public:
  BinaryValues(const std::filesystem::path& path, std::string_view bytes, std::size_t position, bool big_endian)
      : path_(path.string()), bytes_(bytes), position_(position), big_endian_(big_endian) {}

  void begin_row() override {}

  double next(const PlyType& type) override {
    if (ok() && type.size > bytes_.size() - position_)
      fail("the file ends before the last value; it is cut off or its header is wrong");
    if (!ok()) return 0;
    std::array<char, 8> raw = {};
    std::memcpy(raw.data(), bytes_.data() + position_, type.size);
    if (big_endian_) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(type.size));
    position_ += type.size;
    if (!type.is_integer) return type.size == sizeof(float) ? decode<float>(raw) : decode<double>(raw);
    const bool is_signed = type.low < 0;
    if (type.size == 1) return is_signed ? decode<std::int8_t>(raw) : decode<std::uint8_t>(raw);
    if (type.size == 2) return is_signed ? decode<std::int16_t>(raw) : decode<std::uint16_t>(raw);
    return is_signed ? decode<std::int32_t>(raw) : decode<std::uint32_t>(raw);
  }

  void end_row() override {}

  void end_file() override {
    if (position_ < bytes_.size()) fail(fmt::format("{} bytes follow the last element", bytes_.size() - position_));
  }

  [[nodiscard]] bool may_hold(const PlyElement& element) const override {
    std::uint64_t row_size = 0;
    for (const PlyProperty& property : element.properties)
      row_size += property.count_type != nullptr ? property.count_type->size : property.type->size;
    return fits(element.count, row_size, bytes_.size() - position_);
  }

 protected:
  [[nodiscard]] std::string place() const override { return fmt::format("{}: byte {}", path_, position_); }

 private:
  template <typename T>
  static double decode(const std::array<char, 8>& raw) {
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return static_cast<double>(value);
  }

  std::string path_;
  std::string_view bytes_;
  std::size_t position_;
  bool big_endian_;
};

}  // namespace

void PlyValues::fail(std::string_view message) {
  if (!error_) error_ = Error{ErrorKind::kInput, fmt::format("{}: {}", place(), message)};
}

std::unique_ptr<PlyValues> make_ply_values(const std::filesystem::path& path, std::string_view bytes,
                                           const PlyHeader& header) {
  if (header.format == PlyFormat::kAscii)
    return std::make_unique<AsciiValues>(path, bytes.substr(header.size), header.lines);
  return std::make_unique<BinaryValues>(path, bytes, header.size, header.format == PlyFormat::kBigEndian);
}

}  // namespace quorum
