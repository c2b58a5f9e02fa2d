#include "engine/evaluate/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/option.h"
#include "engine/evaluate/distance.h"
#include "engine/evaluate/sample_surface.h"
#include "engine/evaluate/seen_by.h"
#include "engine/mesh/disjoint_sets.h"

namespace quorum {
namespace {

bool is_distance(double value) { return std::isfinite(value) && value > 0; }

/// What is measured from the reconstruction to the truth.
struct ToTruth {
  std::vector<double> distances;  ///< of its samples, ascending
  std::uint64_t far_vertices = 0;
};

Expected<ToTruth> measure_to_truth(const Mesh& reconstruction, const Mesh& truth, const EvaluateOptions& options) {
  QUORUM_ASSIGN(const auto distance, SurfaceDistance::build(truth));
  ToTruth result{distance.to(sample_surface(reconstruction, options.samples, options.seed))};
  std::ranges::sort(result.distances);
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(reconstruction.vertices.size());
  for (const Vertex& vertex : reconstruction.vertices) vertices.push_back(vertex.position.cast<double>());
  result.far_vertices = static_cast<std::uint64_t>(
      std::ranges::count_if(distance.to(vertices), [&](double d) { return d > options.threshold; }));
  return result;
}

/// Distances from the samples of the truth to the reconstruction, ascending.
Expected<std::vector<double>> measure_from_truth(const std::vector<Eigen::Vector3d>& samples,
                                                 const Mesh& reconstruction) {
  QUORUM_ASSIGN(const auto distance, SurfaceDistance::build(reconstruction));
  std::vector<double> distances = distance.to(samples);
  std::ranges::sort(distances);
  return distances;
}

std::uint64_t count_components(const Mesh& mesh) {
  DisjointSets sets(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    sets.join(triangle[0], triangle[1]);
    sets.join(triangle[0], triangle[2]);
  }
  std::vector<bool> is_used(mesh.vertices.size(), mesh.triangles.empty());
  for (const auto& triangle : mesh.triangles) is_used[sets.find(triangle[0])] = true;
  return static_cast<std::uint64_t>(std::ranges::count(is_used, true));
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
  if (!(share >= 0 && share <= 1))
    return failure(ErrorKind::kUsage, fmt::format("{} {}: give 0 to 1", option_name("share"), share));
  if (!is_distance(threshold))
    return failure(ErrorKind::kUsage,
                   fmt::format("{} {}: give a distance above 0", option_name("threshold"), threshold));
  if (!is_distance(cap))
    return failure(ErrorKind::kUsage, fmt::format("{} {}: give a distance above 0", option_name("cap"), cap));
  if (!is_distance(hidden_by))
    return failure(ErrorKind::kUsage,
                   fmt::format("{} {}: give a distance above 0", option_name("hidden-by"), hidden_by));
  if (seen_by < 0)
    return failure(ErrorKind::kUsage, fmt::format("{} {}: give 0 or more", option_name("seen-by"), seen_by));
  for (const double distance : distances)
    if (!is_distance(distance))
      return failure(ErrorKind::kUsage,
                     fmt::format("{} {}: give distances above 0", option_name("distances"), distance));
  if (samples < 1 || samples > kMostSamples)
    return failure(ErrorKind::kUsage,
                   fmt::format("{} {}: give 1 to {}", option_name("samples"), samples, kMostSamples));
  return {};
}

Expected<std::vector<Eigen::Vector3d>> sample_truth(const Mesh& truth, const EvaluateOptions& options,
                                                    const Scene* scene) {
  std::vector<Eigen::Vector3d> samples = sample_surface(truth, options.samples, options.seed);
  if (scene == nullptr || options.seen_by == 0) return samples;
  QUORUM_ASSIGN(const auto sight, Sight::build(truth));
  const std::vector<int> counts = sight.views_that_see(scene->views, samples, options.hidden_by);
  std::vector<Eigen::Vector3d> seen;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (counts[i] >= options.seen_by) seen.push_back(samples[i]);
  if (seen.empty())
    return failure(ErrorKind::kInput, fmt::format("no {} views see any of it; give the scene that it belongs to, or a "
                                                  "smaller {}",
                                                  options.seen_by, option_name("seen-by")));
  return seen;
}

Expected<Evaluation> evaluate(const Mesh& reconstruction, const Mesh& truth, const EvaluateOptions& options,
                              const Scene* scene) {
  QUORUM_TRY(options.check());
  const auto within = [](auto measured, std::string_view side) {
    if (!measured) measured = std::unexpected(measured.error().within(side));
    return measured;
  };
  QUORUM_TRY(within(check_surface(reconstruction), "reconstruction"));
  QUORUM_TRY(within(check_surface(truth), "truth"));
  QUORUM_ASSIGN(const auto to_truth, within(measure_to_truth(reconstruction, truth, options), "truth"));
  QUORUM_ASSIGN(const auto samples, within(sample_truth(truth, options, scene), "truth"));
  QUORUM_ASSIGN(const auto from_truth, within(measure_from_truth(samples, reconstruction), "reconstruction"));

  Evaluation evaluation;
  evaluation.accuracy = distance_that_holds(options.share, to_truth.distances);
  evaluation.median_accuracy = distance_that_holds(0.5, to_truth.distances);
  for (const double distance : to_truth.distances) evaluation.mean_accuracy += std::min(distance, options.cap);
  evaluation.mean_accuracy /= static_cast<double>(to_truth.distances.size());
  evaluation.completeness = share_within(options.threshold, from_truth);
  if (!truth.triangles.empty())
    evaluation.seen_share = static_cast<double>(samples.size()) / static_cast<double>(options.samples);
  evaluation.components = count_components(reconstruction);
  evaluation.vertices = reconstruction.vertices.size();
  evaluation.far_vertices = to_truth.far_vertices;
  for (const double distance : options.distances)
    evaluation.f_scores.push_back(f_score(distance, to_truth.distances, from_truth));
  return evaluation;
}

}  // namespace quorum
