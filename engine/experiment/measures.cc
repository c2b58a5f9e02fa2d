#include "engine/experiment/measures.h"

#include <algorithm>
#include <cmath>

#include "engine/evaluate/distance.h"
#include "engine/io/image_store.h"
#include "engine/volume/range_surface.h"
#include "engine/volume/weigh_surface.h"

namespace quorum {
namespace {

constexpr double kWrong = 0.00125;  // scene units; the completeness threshold of Seitz et al. 2006
constexpr int kTruthSpacing = 3;    // every third pixel of every third row is compared with the truth
constexpr std::size_t kCacheBytes = 256 << 20;

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Collects what the maps of one view after the other tell.
class DepthMapSums {
 public:
  void add(const View& view, const DepthMap& map, const Mask& object, const FusionOptions& fusion) {
    const auto cells =
        range_surface(map.depth, make_range_surface_params(view.camera, view.width, view.height, fusion));
    const auto weights = weigh_surface(map.depth, map.confidence, cells,
                                       make_weigh_surface_params(view.camera, view.width, view.height, fusion));
    for (std::size_t pixel = 0; pixel < map.depth.values.size(); ++pixel) {
      if (map.depth.values[pixel] <= 0.0F) continue;
      ++valid_;
      loose += weights.values[pixel] == 0 ? 1 : 0;
      background += !object.empty() && object.values[pixel] == 0 ? 1 : 0;
      correlation_ += static_cast<double>(map.correlation.values[pixel]);
      confidence_ += static_cast<double>(map.confidence.values[pixel]);
    }
    add_roughness(view, map.depth, weights);
    for (int y = 0; y < view.height; y += kTruthSpacing)
      for (int x = 0; x < view.width; x += kTruthSpacing)
        if (map.depth.at(x, y) > 0.0F) points.push_back(view.camera.unproject(x, y, map.depth.at(x, y)));
  }

  [[nodiscard]] double mean_correlation() const { return valid_ > 0 ? correlation_ / static_cast<double>(valid_) : 0; }
  [[nodiscard]] double mean_confidence() const { return valid_ > 0 ? confidence_ / static_cast<double>(valid_) : 0; }

  std::uint64_t loose = 0;
  std::uint64_t background = 0;
  std::vector<double> roughness;
  std::vector<Eigen::Vector3d> points;  ///< a sample of the depths, in the world

 private:
  void add_roughness(const View& view, const Grid<float>& depth, const Grid<std::uint32_t>& weights) {
    const double focal = view.camera.intrinsics(0, 0);
    for (int y = 0; y < view.height; y += kTruthSpacing) {
      for (int x = 1; x + 1 < view.width; ++x) {
        if (weights.at(x - 1, y) == 0 || weights.at(x, y) == 0 || weights.at(x + 1, y) == 0) continue;
        const double here = depth.at(x, y);
        const double bend = depth.at(x - 1, y) - 2.0 * here + depth.at(x + 1, y);
        roughness.push_back(std::abs(bend) * focal / here);
      }
    }
  }

  std::uint64_t valid_ = 0;
  double correlation_ = 0.0;
  double confidence_ = 0.0;
};

}  // namespace

Expected<DepthMeasures> measure_depth_maps(const OpenScene& scene, const RunOptions& options,
                                           const Workspace& workspace, const RunReport& report,
                                           const Progress& progress) {
  DepthMeasures measures;
  for (const ViewReport& view : report.views) {
    ++measures.views;
    measures.swept_pixels += view.swept_pixels;
    measures.valid_pixels += view.valid_pixels;
    measures.depth_samples += view.depth_samples;
  }
  ImageStore images(scene.scene, kCacheBytes, scene.source->background_level);
  DepthMapSums sums;
  for (int index = 0; index < static_cast<int>(scene.scene.views.size()); ++index) {
    if (progress.stop_requested()) return std::unexpected(stopped());
    const View& view = scene.scene.views[static_cast<std::size_t>(index)];
    if (!workspace.has_depth_map(view.name)) continue;
    QUORUM_ASSIGN(const auto map, workspace.load_depth_map(view.name, view.width, view.height));
    QUORUM_ASSIGN(const auto object, images.mask(index));
    sums.add(view, map, *object, options.fusion);
  }
  measures.loose_pixels = sums.loose;
  measures.background_pixels = sums.background;
  measures.correlation = sums.mean_correlation();
  measures.confidence = sums.mean_confidence();
  measures.roughness = median(sums.roughness);
  if (!scene.truth || sums.points.empty()) return measures;
  QUORUM_ASSIGN(const auto truth, SurfaceDistance::build(*scene.truth));
  std::vector<double> errors = truth.to(sums.points);
  const auto wrong = std::ranges::count_if(errors, [](double error) { return error > kWrong; });
  measures.wrong_share = static_cast<double>(wrong) / static_cast<double>(errors.size());
  measures.median_error = median(errors);
  return measures;
}

Expected<MeshScore> score_mesh(const OpenScene& scene, const Mesh& mesh) {
  MeshScore measures{mesh.vertices.size(), mesh.triangles.size(), std::nullopt};
  if (!scene.truth || mesh.triangles.empty()) return measures;
  EvaluateOptions options;
  options.samples = 200000;
  QUORUM_ASSIGN(auto evaluation, evaluate(mesh, *scene.truth, options));
  measures.evaluation = std::move(evaluation);
  return measures;
}

}  // namespace quorum
