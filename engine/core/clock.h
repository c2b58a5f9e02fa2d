// The clocks by which a run measures itself.
#pragma once

namespace quorum {

/// Seconds since some moment in the past.
double wall_seconds();

/// CPU seconds of all threads of this process so far.
double process_cpu_seconds();

}  // namespace quorum
