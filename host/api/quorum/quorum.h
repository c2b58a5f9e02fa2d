// Quorum: multi-view stereo with one result on every device. All of the library (docs/library.md).
#pragma once

#include <quorum/device.h>
#include <quorum/options.h>
#include <quorum/reconstruct.h>
#include <quorum/result.h>
#include <quorum/results.h>
#include <quorum/scene.h>

#include <string>

namespace quorum::v0 {

/// The version of the library that is linked: "0.1.0".
[[nodiscard]] QUORUM_API std::string version();

}  // namespace quorum::v0
