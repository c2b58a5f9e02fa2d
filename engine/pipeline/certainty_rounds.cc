#include "engine/pipeline/certainty_rounds.h"

#include <string>
#include <utility>

namespace quorum {

namespace {

constexpr float kUnits = 256.0F;  // of a certainty
constexpr float kUnit = 0.00390625F;

}  // namespace

Expected<CertaintyRounds> CertaintyRounds::create(const Run& run) {
  CertaintyRounds rounds(run);
  for (ScratchFile& file : rounds.files_) {
    QUORUM_ASSIGN(file, ScratchFile::create(run.workspace.folder()));
  }
  std::uint64_t place = 0;
  for (const View& view : run.scene.views) {
    rounds.places_.push_back(place);
    place += static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height);
  }
  return rounds;
}

Expected<void> CertaintyRounds::save(int round, int view, const Grid<float>& certainty) const {
  std::string bytes(certainty.values.size(), '\0');
  for (std::size_t pixel = 0; pixel < bytes.size(); ++pixel)
    bytes[pixel] = static_cast<char>(static_cast<unsigned char>(certainty.values[pixel] * kUnits));
  return file_of(round).write(places_[static_cast<std::size_t>(view)], bytes);
}

Expected<Grid<float>> CertaintyRounds::load(int round, int view) const {
  const View& source = run_->view(view);
  Grid<float> certainty(source.width, source.height);
  std::string bytes(certainty.values.size(), '\0');
  QUORUM_TRY(file_of(round).read(places_[static_cast<std::size_t>(view)], bytes));
  for (std::size_t pixel = 0; pixel < bytes.size(); ++pixel)
    certainty.values[pixel] = static_cast<float>(static_cast<unsigned char>(bytes[pixel])) * kUnit;
  return certainty;
}

}  // namespace quorum
