// Which vector instructions the CPU's stages use. A stage is compiled for each level and chosen at run time.
#pragma once

namespace quorum {

/// Instructions that a stage may use. All give the same bytes.
enum class SimdLevel { kBaseline, kAvx2, kAvx512 };

/// The most that this processor has.
SimdLevel best_simd_level();

}  // namespace quorum
