#include "engine/experiment/missed_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/evaluate/distance.h"
#include "engine/evaluate/seen_by.h"

namespace quorum {
namespace {

/// The best that a depth map says of a sample.
enum Depths : std::uint8_t { kNoDepth, kWrongDepth, kRightDepth };

/// The samples that are further from the surface than the threshold.
Expected<std::vector<Eigen::Vector3d>> far_samples(const std::vector<Eigen::Vector3d>& samples, const Mesh& surface,
                                                   double threshold) {
  QUORUM_ASSIGN(const auto distance, SurfaceDistance::build(surface));
  const std::vector<double> distances = distance.to(samples);
  std::vector<Eigen::Vector3d> far;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (distances[i] > threshold) far.push_back(samples[i]);
  return far;
}

/// Takes in what one view's depth map says.
void look_up(const View& view, const Grid<float>& depth, const std::vector<Eigen::Vector3d>& samples,
             const Sight& sight, const EvaluateOptions& options, std::vector<Depths>& found) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (found[i] == kRightDepth || !sight.sees(view, samples[i], options.hidden_by)) continue;
    const Eigen::Vector3d pixel = view.camera.project(samples[i]);
    const auto x = static_cast<int>(std::lround(pixel.x()));
    const auto y = static_cast<int>(std::lround(pixel.y()));
    const double here = depth.at(x, y);
    if (here <= 0) continue;
    const bool right = (view.camera.unproject(x, y, here) - samples[i]).norm() <= options.threshold;
    found[i] = right ? kRightDepth : kWrongDepth;
  }
}

}  // namespace

Expected<MissedTruth> find_missed_truth(const Scene& scene, const Workspace& workspace, const Mesh& mesh,
                                        const Mesh* uncleaned, const Mesh& truth, const EvaluateOptions& options) {
  MissedTruth result;
  QUORUM_ASSIGN(const auto samples, sample_truth(truth, options, &scene));
  result.samples = samples.size();
  QUORUM_ASSIGN(const auto missed, far_samples(samples, mesh, options.threshold));
  QUORUM_ASSIGN(const auto sight, Sight::build(truth));
  std::vector<Depths> found(missed.size(), kNoDepth);
  bool has_maps = false;
  for (const View& view : scene.views) {
    if (!workspace.has_depth_map(view.name)) continue;
    has_maps = true;
    QUORUM_ASSIGN(const auto depth, workspace.load_depth(view.name, view.width, view.height));
    look_up(view, depth, missed, sight, options, found);
  }
  if (!has_maps)
    return failure(ErrorKind::kInput, fmt::format("{}: holds no depths of this scene; run `quorum reconstruct` first",
                                                  (workspace.folder() / "depth").string()));
  std::vector<Eigen::Vector3d> had;
  for (std::size_t i = 0; i < missed.size(); ++i)
    if (found[i] == kRightDepth) had.push_back(missed[i]);
  result.never_depth = static_cast<std::uint64_t>(std::ranges::count(found, kNoDepth));
  result.wrong_depth = static_cast<std::uint64_t>(std::ranges::count(found, kWrongDepth));
  if (uncleaned != nullptr) {
    QUORUM_ASSIGN(const auto before, far_samples(had, *uncleaned, options.threshold));
    result.in_fusion = before.size();
  }
  result.in_clean_up = had.size() - result.in_fusion;
  return result;
}

}  // namespace quorum
