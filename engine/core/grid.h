// A dense two-dimensional array, row by row from the top.
#pragma once

#include <cstddef>
#include <vector>

namespace quorum {

/// width × height values; at(x, y) with x to the right and y down. Empty by default.
template <typename T>
struct Grid {
  int width = 0;
  int height = 0;
  std::vector<T> values;

  Grid() = default;
  Grid(int grid_width, int grid_height, T value = T{})
      : width(grid_width),
        height(grid_height),
        values(static_cast<std::size_t>(grid_width) * static_cast<std::size_t>(grid_height), value) {}

  T& at(int x, int y) { return values[index(x, y)]; }
  const T& at(int x, int y) const { return values[index(x, y)]; }
  T* row(int y) { return values.data() + index(0, y); }
  const T* row(int y) const { return values.data() + index(0, y); }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  [[nodiscard]] bool empty() const { return values.empty(); }
  bool operator==(const Grid&) const = default;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace quorum
