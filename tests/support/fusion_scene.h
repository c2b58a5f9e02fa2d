// The sphere with exact depth maps in a workspace: an input for the second half of a run.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/pipeline/fuse_views.h"
#include "tests/support/test_support.h"

namespace quorum {

/// Eight cameras around the sphere, and one above and one below; their photographs and depth maps as files.
class FusionScene {
 public:
  FusionScene();

  /// The surface, and what was done for it.
  Expected<Mesh> fuse(Backend& backend, RunReport& report, std::uint64_t memory_bytes = 0) const;

 private:
  TemporaryFolder folder_;
  Scene scene_;
};

}  // namespace quorum
