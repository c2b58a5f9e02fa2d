// Room for the stacks of this process.
#pragma once

#include "engine/core/error.h"

namespace quorum {

/// Raises the limit on stacks of this process and of threads to come to 8 MiB, as far as the system lets it: where it
/// is lower, a run would end by a signal in the middle. Fails (kMemory) where that leaves less than 512 KiB.
Expected<void> allow_stacks();

}  // namespace quorum
