// Certainties of all views between two rounds of confirmation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/grid.h"
#include "engine/io/scratch_file.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// Keeps the certainties of the last round while those of the next one are made; a byte a pixel, on the disk of the
/// workspace. Views may be saved and loaded at once.
class CertaintyRounds {
 public:
  /// The run outlives it. Fails (kInput) if the workspace can't be written to.
  static Expected<CertaintyRounds> create(const Run& run);

  /// certainty: multiples of 1/256 below 1, as confirm_depths gives them. Fails (kInput) if the disk is full.
  [[nodiscard]] Expected<void> save(int round, int view, const Grid<float>& certainty) const;
  /// What was saved of this round. That of two rounds before is gone. Fails (kInput).
  [[nodiscard]] Expected<Grid<float>> load(int round, int view) const;

 private:
  explicit CertaintyRounds(const Run& run) : run_(&run) {}
  [[nodiscard]] const ScratchFile& file_of(int round) const { return files_[static_cast<std::size_t>(round % 2)]; }

  const Run* run_;
  std::vector<std::uint64_t> places_;  ///< of each view in a file
  std::array<ScratchFile, 2> files_;   ///< of even and of odd rounds
};

}  // namespace quorum
