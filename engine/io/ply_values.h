// The values after the header of a PLY file, one after the other, whatever its format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/io/ply_header.h"

namespace quorum {

/// Hands out the values row by row. After the first failure all values are 0 and error() names the place.
class PlyValues {
 public:
  virtual ~PlyValues() = default;
  virtual void begin_row() = 0;
  virtual double next(const PlyType& type) = 0;
  /// Fails if the row has a value left, where that can be told.
  virtual void end_row() = 0;
  /// Fails if the file has anything left.
  virtual void end_file() = 0;
  /// False if the file is too short for all rows of an element, so that nothing is ever allocated by a wrong count.
  [[nodiscard]] virtual bool may_hold(const PlyElement& element) const = 0;

  [[nodiscard]] bool ok() const { return !error_; }
  [[nodiscard]] const Error& error() const { return *error_; }
  /// Fails at the present place, unless there is an earlier failure.
  void fail(std::string_view message);

 protected:
  [[nodiscard]] virtual std::string place() const = 0;

 private:
  std::optional<Error> error_;
};

/// The values that follow the header in bytes, which must outlive the result. path: for messages.
std::unique_ptr<PlyValues> make_ply_values(const std::filesystem::path& path, std::string_view bytes,
                                           const PlyHeader& header);

}  // namespace quorum
