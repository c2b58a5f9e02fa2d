// A catalog of tiny scenes, and what the tests of experiments share.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/experiment/run_experiments.h"
#include "engine/pipeline/cpu_backend.h"
#include "tests/support/test_support.h"

namespace quorum {

/// A data set that is nowhere, and a temple seen by small cameras all around.
inline std::vector<ExperimentScene> tiny_scenes() {
  return {{"absentSet", std::nullopt, 0.0, "absent0001", 0},
          {"tiny", TempleOptions{.views = 8, .width = 96}, 0.06, "temple0002", 1}};
}

inline RunSettings tiny_run(std::string label) {
  RunSettings run{"tiny", std::move(label), 0, {}};
  run.options.sweep.step_pixels = 1.0;
  run.options.sweep.refinement = 2;
  run.options.fusion.voxel_size = 0.003;
  run.options.clean.min_component_triangles = 10;
  return run;
}

/// Keeps what it is told; asks to stop once it was told stop_after notes.
class NotedProgress : public Progress {
 public:
  void note(std::string_view text) override { notes.emplace_back(text); }
  [[nodiscard]] bool stop_requested() const override { return stop_after > 0 && notes.size() >= stop_after; }

  /// How many notes hold the text.
  [[nodiscard]] int count(const std::string& text) const {
    int found = 0;
    for (const std::string& note : notes) found += note.find(text) != std::string::npos ? 1 : 0;
    return found;
  }

  std::vector<std::string> notes;
  std::size_t stop_after = 0;
};

}  // namespace quorum
