// What the processor can do at most, measured: the yardstick of the benchmark.
#pragma once

namespace quorum {

/// Rates of all threads that oneTBB uses, together.
struct HostRates {
  int threads = 0;
  double bytes_per_second = 0.0;       ///< read and written by a copy that is far larger than the caches
  double operations_per_second = 0.0;  ///< 32-bit multiplications and additions on independent values in registers
};

/// Takes about half a second. Instructions as the sweep may use them: AVX-512, AVX2 or what the compiler targets.
HostRates measure_host_rates();

}  // namespace quorum
