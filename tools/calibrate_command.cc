// quorum calibrate: how far the confidences of depth maps can be trusted, against a known surface.
#include <fmt/format.h>

#include "engine/experiment/calibration.h"
#include "engine/io/file.h"
#include "engine/io/ply.h"
#include "engine/io/scene_folder.h"
#include "tools/add_options.h"
#include "tools/messages.h"

namespace quorum {
namespace {

struct CalibrateArguments {
  std::filesystem::path scene;
  std::filesystem::path truth;
  std::filesystem::path workspace;
  std::filesystem::path picture;
  RunOptions options;
};

void print_table(const char* name, const Calibration& calibration) {
  print("{:<12} {:>9}  {:>10}  {:>11}\n", name, "depths", "mean", "right share");
  for (int bin = 0; bin < kCalibrationBins; ++bin) {
    const CalibrationBin& sums = calibration.bins[static_cast<std::size_t>(bin)];
    if (sums.count == 0) continue;
    print("{:.1f} to {:.1f}   {:>9}  {:>10.3f}  {:>11.3f}\n", bin / double{kCalibrationBins},
          (bin + 1) / double{kCalibrationBins}, sums.count, sums.confidence(), sums.share());
  }
  print("mean distance of confidence and share {:.3f}\n\n", calibration.error());
}

Expected<void> calibrate_files(const CalibrateArguments& arguments) {
  QUORUM_ASSIGN(const auto scene, read_scene(arguments.scene, arguments.options.files));
  QUORUM_ASSIGN(const auto truth, read_ply(arguments.truth, scene.offset));
  const Workspace workspace = Workspace::at(arguments.workspace);
  QUORUM_ASSIGN(const auto result, calibrate(scene, workspace, truth));
  print_table("confidence", result.confidence);
  print_table("certainty", result.certainty);
  if (arguments.picture.empty()) return {};
  const CalibrationCurve curves[] = {{"confidence (the paper)", result.confidence}, {"certainty", result.certainty}};
  return write_file(arguments.picture, calibration_svg(curves));
}

}  // namespace

int calibrate_command(int argc, char** argv) {
  CommandLine line("Compare depth maps with the truth: the share of right depths at each confidence.", "calibrate");
  CalibrateArguments arguments;
  line.add("scene", arguments.scene, "Folder of the scene").required();
  line.add("truth", arguments.truth, "PLY file of the true surface").required();
  line.add("-o,--output", arguments.workspace, "Folder with the depth maps of `quorum reconstruct`").required();
  line.add("--picture", arguments.picture, "SVG file for the curves");
  add_named_options(line, arguments.options, {"format", "images", "model", "max-image-size"});
  return run_command(line, argc, argv, [&] { return calibrate_files(arguments); });
}

}  // namespace quorum
