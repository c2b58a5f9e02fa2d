// How far a confidence can be trusted: the share of right depths among those of each confidence.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/mesh/mesh.h"
#include "engine/pipeline/workspace.h"
#include "engine/scene/scene.h"

namespace quorum {

constexpr int kCalibrationBins = 10;

/// The depths whose confidence lies in one tenth of 0..1.
struct CalibrationBin {
  std::uint64_t count = 0;
  std::uint64_t right = 0;
  double confidence_sum = 0.0;

  [[nodiscard]] double confidence() const { return count > 0 ? confidence_sum / static_cast<double>(count) : 0.0; }
  [[nodiscard]] double share() const {
    return count > 0 ? static_cast<double>(right) / static_cast<double>(count) : 0.0;
  }
};

/// Depths by confidence; a confidence of 1 is in the last bin.
struct Calibration {
  std::array<CalibrationBin, kCalibrationBins> bins;

  /// confidence: 0..1.
  void add(double confidence, bool right);
  [[nodiscard]] std::uint64_t count() const;
  /// Mean distance between the confidence of a bin and its share of right depths, by depths; 0 without depths.
  [[nodiscard]] double error() const;
};

/// The two confidences of a depth: the paper's, and what other views make of it.
struct ConfidenceCalibration {
  Calibration confidence;  ///< conf(d)
  Calibration certainty;   ///< of confirm_depths
};

/// Compares every third pixel of every third row of all depth maps with the true surface. A depth is right if it lies
/// within a footprint of its pixel of the surface. Fails (kInput) if no view has a depth map and its certainty, or a
/// file does not fit its view, and as SurfaceDistance does.
Expected<ConfidenceCalibration> calibrate(const Scene& scene, const Workspace& workspace, const Mesh& truth);

/// A curve of a figure.
struct CalibrationCurve {
  std::string label;
  Calibration calibration;
};

/// An SVG picture: the share of right depths over the confidence, a line per curve, and the diagonal on which a
/// calibrated confidence lies. Bins of less than a thousandth of the depths are left out.
std::string calibration_svg(std::span<const CalibrationCurve> curves);

}  // namespace quorum
