#include "engine/experiment/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/evaluate/distance.h"

namespace quorum {
namespace {

constexpr int kSpacing = 3;  // every third pixel of every third row is compared with the truth

/// Adds the depths of one view.
void add_view(const View& view, const DepthMap& map, const Grid<float>& certainty, const SurfaceDistance& truth,
              ConfidenceCalibration& sums) {
  const double focal = (view.camera.intrinsics(0, 0) + view.camera.intrinsics(1, 1)) / 2.0;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::pair<int, int>> pixels;
  for (int y = 0; y < view.height; y += kSpacing) {
    for (int x = 0; x < view.width; x += kSpacing) {
      if (!(map.depth.at(x, y) > 0.0F)) continue;
      points.push_back(view.camera.unproject(x, y, static_cast<double>(map.depth.at(x, y))));
      pixels.emplace_back(x, y);
    }
  }
  const std::vector<double> errors = truth.to(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y] = pixels[i];
    const bool right = errors[i] <= static_cast<double>(map.depth.at(x, y)) / focal;
    sums.confidence.add(static_cast<double>(map.confidence.at(x, y)), right);
    sums.certainty.add(static_cast<double>(certainty.at(x, y)), right);
  }
}

}  // namespace

void Calibration::add(double confidence, bool right) {
  const int bin = std::clamp(static_cast<int>(confidence * kCalibrationBins), 0, kCalibrationBins - 1);
  CalibrationBin& sums = bins[static_cast<std::size_t>(bin)];
  ++sums.count;
  sums.right += right ? 1 : 0;
  sums.confidence_sum += confidence;
}

std::uint64_t Calibration::count() const {
  std::uint64_t sum = 0;
  for (const CalibrationBin& bin : bins) sum += bin.count;
  return sum;
}

double Calibration::error() const {
  double sum = 0.0;
  for (const CalibrationBin& bin : bins)
    sum += static_cast<double>(bin.count) * std::abs(bin.confidence() - bin.share());
  return count() > 0 ? sum / static_cast<double>(count()) : 0.0;
}

Expected<ConfidenceCalibration> calibrate(const Scene& scene, const Workspace& workspace, const Mesh& truth) {
  QUORUM_ASSIGN(const auto distance, SurfaceDistance::build(truth));
  ConfidenceCalibration sums;
  for (const View& view : scene.views) {
    if (!workspace.has_depth_map(view.name)) continue;
    QUORUM_ASSIGN(const auto map, workspace.load_weighed_depth(view.name, view.width, view.height, false));
    QUORUM_ASSIGN(const auto certainty, workspace.load_certainty(view.name, view.width, view.height));
    add_view(view, map, certainty, distance, sums);
  }
  if (sums.confidence.count() == 0)
    return failure(ErrorKind::kInput, fmt::format("{}: holds no depths of this scene; run `quorum reconstruct` first",
                                                  (workspace.folder() / "depth").string()));
  return sums;
}

std::string calibration_svg(std::span<const CalibrationCurve> curves) {
  constexpr int kSide = 320;
  constexpr int kLeft = 56;
  constexpr int kTop = 16;
  constexpr int kBottom = 48;
  constexpr int kLegend = 190;
  constexpr double kLeastShare = 0.001;
  constexpr const char* kColors[] = {"#b03a2e", "#1f618d", "#d68910", "#1e8449", "#7d3c98", "#566573"};
  const auto px = [](double value) { return kLeft + kSide * value; };
  const auto py = [](double value) { return kTop + kSide * (1.0 - value); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      kLeft + kSide + kLegend, kTop + kSide + kBottom);
  for (int tick = 0; tick <= 5; ++tick) {
    const double value = tick / 5.0;
    svg += fmt::format(
        "<path d=\"M{0:.1f} {2:.1f}V{3:.1f}M{4:.1f} {1:.1f}H{5:.1f}\" stroke=\"#dddddd\" fill=\"none\"/>\n"
        "<text x=\"{0:.1f}\" y=\"{6:.1f}\" text-anchor=\"middle\">{7:.1f}</text>\n"
        "<text x=\"{8:.1f}\" y=\"{9:.1f}\" text-anchor=\"end\">{7:.1f}</text>\n",
        px(value), py(value), py(0), py(1), px(0), px(1), py(0) + 16, value, px(0) - 6, py(value) + 4);
  }
  svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#888888\" stroke-dasharray=\"4 4\"/>\n", px(0),
                     py(0), px(1), py(1));
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">confidence</text>\n", px(0.5), py(0) + 36);
  svg += fmt::format(
      "<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">share of right depths</text>\n",
      py(0.5));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* color = kColors[i % std::size(kColors)];
    const Calibration& calibration = curves[i].calibration;
    std::string line;
    for (const CalibrationBin& bin : calibration.bins) {
      if (static_cast<double>(bin.count) < kLeastShare * static_cast<double>(calibration.count()) || bin.count == 0)
        continue;
      line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", px(bin.confidence()), py(bin.share()));
    }
    const double y = kTop + 14 + 18.0 * static_cast<double>(i);
    svg += fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"2\" fill=\"none\"/>\n", line, color);
    svg += fmt::format("<path d=\"M{0:.1f} {2:.1f}H{1:.1f}\" stroke=\"{3}\" stroke-width=\"2\"/>\n", px(1) + 12,
                       px(1) + 32, y - 4, color);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", px(1) + 38, y, curves[i].label);
  }
  return svg + "</svg>\n";
}

}  // namespace quorum
