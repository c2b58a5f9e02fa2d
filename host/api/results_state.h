// Results as the library keeps them.
#pragma once

#include <quorum/results.h>

#include <optional>

#include "engine/io/scratch_folder.h"
#include "engine/pipeline/workspace.h"

namespace quorum::v0 {

struct Results::State {
  Scene scene;
  quorum::Workspace workspace;
  std::optional<quorum::ScratchFolder> files;  ///< the workspace, if nobody keeps it
};

}  // namespace quorum::v0
