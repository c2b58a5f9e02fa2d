// The device that --device asks for, opened.
#pragma once

#include <memory>
#include <string>

#include "engine/pipeline/cpu_backend.h"

namespace quorum {

/// request: as --device takes it. Fails (kNoDevice) if there is no such device; the message lists what there is.
Expected<std::unique_ptr<Backend>> open_backend(const std::string& request, const CpuSweepOptions& cpu);

}  // namespace quorum
