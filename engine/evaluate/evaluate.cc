#include "engine/evaluate/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/evaluate/distance.h"
#include "engine/evaluate/sample_surface.h"

namespace quorum {
namespace {

bool is_distance(double value) { return std::isfinite(value) && value > 0; }

/// Distances from one surface to the other; neither is empty.
Expected<std::vector<double>> distances_between(const Mesh& from, const Mesh& to, const EvaluateOptions& options) {
  const auto distance = SurfaceDistance::build(to);
  if (!distance) return std::unexpected(distance.error());
  return distance->to(sample_surface(from, options.samples, options.seed));
}

/// The smallest distance that at least this share does not exceed. sorted: ascending, not empty.
double distance_that_holds(double share, const std::vector<double>& sorted) {
  constexpr double kRounding = 1e-6;  // 0.07 · 100 is a hair above 7 in doubles and must not become 8
  const double count = std::ceil(share * static_cast<double>(sorted.size()) - kRounding);
  return sorted[static_cast<std::size_t>(std::max(count, 1.0)) - 1];
}

/// Share of the distances that are at most the limit. sorted: ascending, not empty.
double share_within(double limit, const std::vector<double>& sorted) {
  const auto within = std::upper_bound(sorted.begin(), sorted.end(), limit) - sorted.begin();
  return static_cast<double>(within) / static_cast<double>(sorted.size());
}

FScore f_score(double distance, const std::vector<double>& to_truth, const std::vector<double>& to_reconstruction) {
  const double precision = share_within(distance, to_truth);
  const double recall = share_within(distance, to_reconstruction);
  const double sum = precision + recall;
  return {distance, precision, recall, sum > 0 ? 2 * precision * recall / sum : 0};
}

}  // namespace

Expected<void> EvaluateOptions::check() const {
  constexpr std::uint64_t kMostSamples = 100'000'000;
  if (!(share >= 0 && share <= 1)) return failure(ErrorKind::kUsage, fmt::format("--share {}: give 0 to 1", share));
  if (!is_distance(threshold))
    return failure(ErrorKind::kUsage, fmt::format("--threshold {}: give a distance above 0", threshold));
  for (const double distance : distances)
    if (!is_distance(distance))
      return failure(ErrorKind::kUsage, fmt::format("--distances {}: give distances above 0", distance));
  if (samples < 1 || samples > kMostSamples)
    return failure(ErrorKind::kUsage, fmt::format("--samples {}: give 1 to {}", samples, kMostSamples));
  return {};
}

Expected<Evaluation> evaluate(const Mesh& reconstruction, const Mesh& truth, const EvaluateOptions& options) {
  if (auto checked = options.check(); !checked) return std::unexpected(checked.error());
  if (auto checked = check_surface(reconstruction); !checked)
    return std::unexpected(checked.error().within("reconstruction"));
  if (auto checked = check_surface(truth); !checked) return std::unexpected(checked.error().within("truth"));

  auto to_truth = distances_between(reconstruction, truth, options);
  if (!to_truth) return std::unexpected(to_truth.error().within("truth"));
  auto to_reconstruction = distances_between(truth, reconstruction, options);
  if (!to_reconstruction) return std::unexpected(to_reconstruction.error().within("reconstruction"));
  std::ranges::sort(*to_truth);
  std::ranges::sort(*to_reconstruction);

  Evaluation evaluation;
  evaluation.accuracy = distance_that_holds(options.share, *to_truth);
  evaluation.median_accuracy = distance_that_holds(0.5, *to_truth);
  evaluation.mean_accuracy =
      std::accumulate(to_truth->begin(), to_truth->end(), 0.0) / static_cast<double>(to_truth->size());
  evaluation.completeness = share_within(options.threshold, *to_reconstruction);
  for (const double distance : options.distances)
    evaluation.f_scores.push_back(f_score(distance, *to_truth, *to_reconstruction));
  return evaluation;
}

}  // namespace quorum
