// SHA-256 (FIPS 180-4) of bytes, by OpenSSL.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace quorum {

/// Takes bytes piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  /// The bytes of values that hold no padding.
  template <typename Value>
  void add_values(const Value* values, std::size_t count) {
    add({reinterpret_cast<const char*>(values), count * sizeof(Value)});
  }
  /// Of all bytes so far, 64 digits. Nothing may be added after that.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Of all of the bytes.
std::string sha256(std::string_view bytes);

}  // namespace quorum
