// A box as people type it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/bounds.h"
#include "engine/core/error.h"

namespace quorum {

/// Six numbers x0 y0 z0 x1 y1 z1, apart by spaces or commas, in one word or in several. name: of the option. Fails
/// (kUsage).
Expected<Bounds> parse_bounds(std::string_view name, const std::vector<std::string>& words);

}  // namespace quorum
