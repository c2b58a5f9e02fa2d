// The versions of what the stages compute.
#pragma once

namespace quorum {

/// A change of a stage's result, the same input and options given, raises its number. docs/conformance.md has the bytes
/// that belong to these numbers, and a test holds both together.
constexpr int kDepthVersion = 6;   ///< depth maps
constexpr int kFusionVersion = 4;  ///< certainty, volume, mesh

}  // namespace quorum
