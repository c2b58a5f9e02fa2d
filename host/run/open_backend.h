// The device that the options ask for, opened, and the threads that it may use.
#pragma once

#include <oneapi/tbb/global_control.h>

#include <memory>
#include <optional>

#include "engine/pipeline/backend.h"
#include "engine/pipeline/run_options.h"

namespace quorum {

/// Fails (kNoDevice) if there is no such device; the message lists what there is.
Expected<std::unique_ptr<Backend>> open_backend(const RunOptions& options);

/// While it lives, no more threads than this compute; 0 = as many as there are.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0) limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }

 private:
  std::optional<tbb::global_control> limit_;
};

}  // namespace quorum
