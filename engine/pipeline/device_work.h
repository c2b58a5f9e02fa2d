// What a run asked of a device, counted: this does not depend on the machine's speed, and shows what the device waits
// for.
#pragma once

#include <cstdint>

namespace quorum {

/// All 0 where the host is the device.
struct DeviceWork {
  std::uint64_t uploaded_bytes = 0;
  std::uint64_t downloaded_bytes = 0;
  std::uint64_t submissions = 0;  ///< each of which the host waits for
  std::uint64_t dispatches = 0;
  std::uint64_t allocations = 0;  ///< of memory
  double waited_seconds = 0.0;    ///< by the host, for submissions to end
};

}  // namespace quorum
