// The innermost loops of planes (score_planes.h) and of the sweep (sweep_tile.h), with 16-bit words where the processor
// multiplies them in pairs: sums over windows on tilted planes in one neighbor, and samples of a row.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/simd.h"
#include "engine/depth/texel_columns.h"
#include "engine/depth/tile_supports.h"

namespace quorum {

/// Windows whose sums are taken together, and the sums. Arrays hold whole vectors.
struct WindowLanes {
  static constexpr int kCapacity = 128;  ///< so that all of it stays in the first cache
  static constexpr int kGroup = 16;      ///< lanes whose samples lie together
  template <typename T>
  using Lanes = std::array<T, kCapacity>;

  /// Samples of the reference of a group's lanes at one place of the window, as TileSupports has them; in the order of
  /// WindowSumForm::order.
  struct Place {
    alignas(64) std::uint64_t samples[kGroup];
  };

  int window = 0;  ///< side, pixels

  // Placements in the neighbor, all 0 if it does not see the window.
  alignas(64) Lanes<std::int32_t> u = {}, v = {}, u_x = {}, v_x = {}, u_y = {}, v_y = {};

  std::vector<Place> reference;  ///< window² of the first group, of the second, …

  // Sums, as WindowSums has them.
  alignas(64) Lanes<std::int32_t> b[3] = {}, bb = {}, ab = {};
};

/// A way to sum windows. All give the same.
struct WindowSumForm {
  /// The lane of a group, 0 to 15, whose samples stand at each place among those of the group.
  std::array<std::uint8_t, WindowLanes::kGroup> order = {};
  /// Sums the first `count` windows, with samples that drop `shift` bits. Lanes beyond them, up to a whole group, must
  /// lie in the neighbor, too.
  void (*sum)(const TexelColumns& neighbor, int count, int shift, WindowLanes& lanes) = nullptr;
};

/// The fastest form of a level that the processor has.
WindowSumForm window_sum_form(SimdLevel simd);

/// Where samples of a row lie in the neighbor.
struct RowPositions {
  const std::int32_t* u;      ///< 1/256 pixel
  const std::int32_t* v;      ///< 1/256 pixel
  const std::int32_t* texel;  ///< as texel_index gives it
};
/// Samples of a row in the neighbor, and what the sums of windows need of them.
struct RowSamples {
  std::int32_t* red;
  std::int32_t* green;
  std::int32_t* blue;
  std::int32_t* squares;   ///< summed over the channels
  std::int32_t* products;  ///< with those of the reference, likewise
};
/// Takes samples that drop `shift` bits. reference: those of the reference, 16 bits for each of red, green and blue,
/// and 16 more of 0. count: a multiple of 8.
using RowSampler = void (*)(const TexelColumns& neighbor, const RowPositions& at, const std::uint64_t* reference,
                            int count, int shift, const RowSamples& row);

/// The fastest one of a level that the processor has; null where plain loops are no slower.
RowSampler row_sampler(SimdLevel simd);

}  // namespace quorum
