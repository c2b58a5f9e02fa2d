// The records of a workspace and of experiments, JSON: options that a run may have, or a line. Fusion takes the options
// of depth maps from them, and the end of a sharded run those of the surface.
#include <cstdlib>
#include <string>

#include "engine/experiment/run_record.h"
#include "engine/pipeline/provenance.h"
#include "engine/pipeline/workspace.h"
#include "tests/fuzz/fuzz_folder.h"

namespace {

/// Whatever was taken, a run with it must be possible or refused in a line.
void require_sound(const quorum::Expected<void>& taken, const quorum::RunOptions& options) {
  if (taken ? !options.check().has_value() : taken.error().message.empty()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  quorum::RunOptions surface;
  require_sound(quorum::take_surface_options(surface, text), surface);

  const auto& folder = quorum::fill_folder("@@ depth/a.depth.json\n" + text);
  quorum::Scene scene;
  scene.views.emplace_back().name = "a";
  quorum::RunOptions depth;
  require_sound(quorum::take_depth_options(depth, scene, quorum::Workspace::at(folder)), depth);

  if (const auto record = quorum::read_record(text); !record && record.error().message.empty()) std::abort();
  return 0;
}
