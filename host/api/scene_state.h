// A scene as the library keeps it.
#pragma once

#include <quorum/scene.h>

#include <optional>

#include "engine/io/scratch_folder.h"
#include "engine/pipeline/run_options.h"
#include "engine/scene/scene.h"

namespace quorum::v0 {

struct Scene::State {
  quorum::Scene scene;
  quorum::RunOptions options;                  ///< with which it was read
  std::optional<quorum::ScratchFolder> files;  ///< the photographs of arrays
};

/// Ends the process if there is no such view.
void require_view(const Scene& scene, int view);

}  // namespace quorum::v0
