#include "engine/depth/refine_planes.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>

#include "engine/depth/fit_planes.h"
#include "engine/depth/place_window.h"
#include "engine/depth/score_planes.h"
#include "engine/depth/support_windows.h"
#include "engine/depth/vote_depth.h"
#include "tests/support/sphere_scene.h"

namespace quorum {
namespace {

constexpr int kRefineWidth = 110;
constexpr int kRefineHeight = 80;

std::vector<SimdLevel> simd_levels() {
  std::vector<SimdLevel> levels;
  for (const SimdLevel simd : {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512})
    if (simd <= best_simd_level()) levels.push_back(simd);
  return levels;
}

/// The plane that touches the sphere where the ray of a pixel meets it.
PlaneTrial tangent_plane(const View& view, int x, int y) {
  const double depth = sphere_depth(view, x, y);
  const Eigen::Vector3d point = view.camera.to_camera(view.camera.unproject(x, y, depth));
  const Eigen::Vector3d center = view.camera.to_camera(Eigen::Vector3d::Zero());
  const Eigen::Vector3d normal = point - center;
  // normal · (z K^-1 (x, y, 1)) = normal · point, so 1 / z = (normal^T K^-1) (x, y, 1) / (normal · point).
  const Eigen::RowVector3d plane = normal.transpose() * view.camera.intrinsics.inverse() / normal.dot(point);
  return {static_cast<float>(1.0 / depth), static_cast<float>(plane(0)), static_cast<float>(plane(1)), 0.0F, 0};
}

PlaneTrial random_plane(std::mt19937& random, const PlaneTrial& around) {
  std::normal_distribution<float> noise(0.0F, 1.0F);
  return {around.inverse_depth * (1.0F + 0.02F * noise(random)), around.slope_x + 1e-3F * noise(random),
          around.slope_y + 1e-3F * noise(random), 0.0F, 0};
}

/// Pixels of a view that see the sphere and whose windows lie in the image.
template <typename Visit>
void for_each_sphere_pixel(const View& view, int radius, const Visit& visit) {
  for (int y = radius; y < kRefineHeight - radius; ++y)
    for (int x = radius; x < kRefineWidth - radius; ++x)
      if (sphere_depth(view, x, y) > 0.0) visit(x, y);
}

TEST(PlaceWindow, SamplesLieWhereTheHomographyPutsThem) {
  const SphereScene sphere = make_sphere_scene(3, kRefineWidth, kRefineHeight, true, 1);
  const SweepTask task = make_sphere_task(sphere, 1, {});
  const Camera& reference = sphere.scene.views[1].camera;
  double largest = 0.0;
  int seen = 0;
  for_each_sphere_pixel(sphere.scene.views[1], 7, [&](int x, int y) {
    const PlaneTrial plane = tangent_plane(sphere.scene.views[1], x, y);
    constexpr float kModerate = 0.007F;  // 45 degrees at this focal length
    if (std::hypot(plane.slope_x, plane.slope_y) > kModerate * plane.inverse_depth) return;
    for (const std::size_t neighbor : {0U, 1U}) {
      const Camera& other = sphere.scene.views[neighbor == 0 ? 0 : 2].camera;
      const WindowPlacement at = place_window(task.warps[neighbor], x, y, plane.inverse_depth, plane.slope_x,
                                              plane.slope_y, 2, kRefineWidth, kRefineHeight);
      if (!at.seen) continue;
      ++seen;
      for (const auto& [dx, dy] : {std::pair{0, 0}, {-2, -2}, {2, -2}, {-2, 2}, {2, 2}}) {
        const double slope_x = plane.slope_x;
        const double slope_y = plane.slope_y;
        const double depth = 1.0 / (plane.inverse_depth + slope_x * dx + slope_y * dy);
        const Eigen::Vector3d expected = other.project(reference.unproject(x + dx, y + dy, depth));
        const double u = (at.u + dx * at.u_x + dy * at.u_y) / static_cast<double>(kPlacementScale);
        const double v = (at.v + dx * at.v_x + dy * at.v_y) / static_cast<double>(kPlacementScale);
        largest = std::max({largest, std::abs(u - expected.x()), std::abs(v - expected.y())});
      }
    }
  });
  EXPECT_GT(seen, 3000);
  EXPECT_LT(largest, 0.05);  // perspective in a window of a small image; a sample is rounded to 1/256
}

TEST(PlaceWindow, PlanesThroughTheCameraAndBehindItAreNotSeen) {
  const SphereScene sphere = make_sphere_scene(2, kRefineWidth, kRefineHeight, false, 1);
  const SweepTask task = make_sphere_task(sphere, 0, {});
  const auto sees = [&](float inverse_depth, float slope_x, float slope_y) {
    return place_window(task.warps[0], 50, 40, inverse_depth, slope_x, slope_y, 2, kRefineWidth, kRefineHeight).seen;
  };
  EXPECT_TRUE(sees(0.25F, 0.0F, 0.0F));
  EXPECT_FALSE(sees(0.25F, 1e9F, 0.0F));
  EXPECT_FALSE(sees(0.25F, 0.0F, -1e30F));
  EXPECT_FALSE(sees(-5.0F, 0.0F, 0.0F));
  EXPECT_FALSE(sees(1e30F, 0.0F, 0.0F));
  EXPECT_FALSE(sees(0.25F, std::nanf(""), 0.0F));
  EXPECT_FALSE(sees(std::nanf(""), 0.0F, 0.0F));
}

TEST(ScorePlanes, ManyAtATimeGiveTheSameBytesAsOne) {
  for (const int window : {3, 5, 9, 15}) {
    SweepOptions options;
    options.window = window;
    const SphereScene sphere = make_sphere_scene(4, kRefineWidth, kRefineHeight, true, static_cast<unsigned>(window));
    const SweepTask task = make_sphere_task(sphere, 1, options);
    const Grid<SupportWindow> windows = make_support_windows(*task.reference, window, 40);
    const VoteRule rule = make_vote_rule(options, task.neighbor_count());
    for (const SimdLevel simd : simd_levels()) {
      const PlaneScorer scorer = make_plane_scorer(task, windows, simd);
      TileSupports supports;
      supports.pack(task, windows, {0, 0, kRefineWidth, kRefineHeight}, simd);
      std::mt19937 random(7);
      const auto batch = std::make_unique<PlaneBatch>();
      std::vector<PlaneTrial> expected;
      for_each_sphere_pixel(sphere.scene.views[1], window / 2, [&](int x, int y) {
        if (random() % 13 != 0 || batch->full()) return;
        PlaneTrial plane = random_plane(random, tangent_plane(sphere.scene.views[1], x, y));
        const float least = random() % 3 == 0 ? 0.5F : 0.0F;
        batch->add(x, y, plane, least);
        for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
          const float ncc = plane_ncc(task, windows.at(x, y), neighbor, x, y, plane);
          if (ncc > rule.threshold) plane.ncc_sum += ncc, ++plane.votes;
        }
        if (can_win(plane.ncc_sum, plane.votes, 0, least, rule)) expected.push_back(plane);
      });
      const int tried = batch->count;
      std::uint64_t samples = 0;
      score_planes(scorer, supports, *batch, samples);
      ASSERT_GT(expected.size(), 20U);
      ASSERT_LT(static_cast<int>(expected.size()), tried - 10);
      ASSERT_EQ(batch->count, static_cast<int>(expected.size()));
      EXPECT_GT(samples, static_cast<std::uint64_t>(window * window * tried));
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const PlaneTrial found{batch->inverse_depth[i], batch->slope_x[i], batch->slope_y[i], batch->ncc_sum[i],
                               batch->votes[i]};
        ASSERT_EQ(std::memcmp(&found, &expected[i], sizeof(found)), 0) << "window " << window << " plane " << i;
      }
    }
  }
}

TEST(FitPlanes, APlaneIsFoundAndALineIsNot) {
  DepthPlanes planes;
  planes.refinement = 2;
  for (int i = 0; i < 200; ++i) {
    planes.inverse_depth.push_back(1.0F - 0.001F * static_cast<float>(i));
    planes.depth.push_back(1.0F / planes.inverse_depth.back());
  }
  Grid<PixelVote> votes(20, 20, PixelVote{0.0F, 0.0F, -1});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) votes.at(x, y).plane = 100 - x + 2 * (y / 2);
  const Grid<PlaneTrial> fitted = fit_planes(votes, planes);
  EXPECT_NEAR(fitted.at(10, 10).slope_x, 0.001, 5e-5);
  EXPECT_NEAR(fitted.at(10, 10).slope_y, -0.001, 2e-4);  // depths come in steps of two rows
  EXPECT_NEAR(fitted.at(10, 10).inverse_depth, planes.inverse_depth[100], 2e-3);
  EXPECT_NEAR(fitted.at(0, 0).slope_x, 0.001, 5e-5);

  Grid<PixelVote> line(20, 20, PixelVote{0.0F, 0.0F, -1});
  for (int x = 0; x < 20; ++x) line.at(x, 10).plane = 100 + x;
  const PlaneTrial flat = fit_planes(line, planes).at(10, 10);
  EXPECT_EQ(flat.slope_x, 0.0F);
  EXPECT_EQ(flat.slope_y, 0.0F);
  EXPECT_EQ(flat.inverse_depth, planes.inverse_depth[110]);
  EXPECT_EQ(fit_planes(line, planes).at(10, 9).inverse_depth, 0.0F);
}

TEST(PlaneMoves, APlaneNearThePixelsOwnIsNotTried) {
  const PixelPlane best{1.0F, 0.01F, 0.0F, 0.9F, 0.5F, 0};
  const PlaneMove move{1, 0, 0.0F, 0.0F, 0.0F, 0.004F, 0.002F, 0};
  const auto tries = [&](float inverse_depth, float slope_x, float slope_y, int taken_by = 2) {
    const PixelPlane other{inverse_depth + slope_x, slope_x, slope_y, 0.9F, 0.9F, taken_by};  // one pixel to the right
    return move_plane(move, best, other).inverse_depth != 0.0F;
  };
  EXPECT_FALSE(tries(1.003F, 0.011F, -0.001F));
  EXPECT_TRUE(tries(1.005F, 0.011F, -0.001F));
  EXPECT_TRUE(tries(0.995F, 0.01F, 0.0F));
  EXPECT_TRUE(tries(1.003F, 0.013F, 0.0F));
  EXPECT_TRUE(tries(1.003F, 0.01F, -0.003F));
  EXPECT_FALSE(tries(1.005F, 0.011F, -0.001F, 0)) << "did not change";
  EXPECT_NE(move_plane(move, kNoPlane, {1.0F, 0.01F, 0.0F, 0.9F, 0.9F, 1}).inverse_depth, 0.0F);
}

TEST(PlaneMoves, AStepIsNotTakenBack) {
  DepthPlanes planes;
  for (int i = 0; i < 4; ++i) planes.inverse_depth.push_back(1.0F - 0.01F * static_cast<float>(i));
  for (const std::vector<PlaneMove>& round : plane_rounds(planes, 5)) {
    int steps = 0;
    for (std::size_t i = 0; i < round.size(); ++i) {
      const PlaneMove& move = round[i];
      if (move.undoes == 0) continue;
      ++steps;
      const PlaneMove& there = round[static_cast<std::size_t>(move.undoes - 1)];
      EXPECT_EQ(move.undoes, static_cast<int>(i));
      EXPECT_EQ(move.inverse_depth, -there.inverse_depth);
      EXPECT_EQ(move.slope_x, -there.slope_x);
      EXPECT_EQ(move.slope_y, -there.slope_y);
      EXPECT_EQ(move_plane(move, {1.0F, 0.0F, 0.0F, 0.9F, 0.5F, move.undoes}, kNoPlane).inverse_depth, 0.0F);
      EXPECT_NE(move_plane(move, {1.0F, 0.0F, 0.0F, 0.9F, 0.5F, 1}, kNoPlane).inverse_depth, 0.0F);
      EXPECT_NE(move_plane(there, {1.0F, 0.0F, 0.0F, 0.9F, 0.5F, 0}, kNoPlane).inverse_depth, 0.0F);
    }
    EXPECT_EQ(steps, 3);
  }
}

Grid<PixelPlane> refined(const SweepTask& task, const CpuSweepOptions& cpu = {}) {
  return refine_planes(task, sweep_planes(task, task.ranges, task.planes.refinement, cpu), cpu);
}

TEST(RefinePlanes, FindDepthAndSlopesOfASphereWhereFlatWindowsDoNot) {
  const SphereScene sphere = make_sphere_scene(5, kRefineWidth, kRefineHeight, true, 3);
  const View& view = sphere.scene.views[2];
  SweepOptions options;
  const Grid<PixelPlane> planes = refined(make_sphere_task(sphere, 2, options));
  options.window_model = WindowModel::kPlane;
  const DepthMap flat = sweep_depth(make_sphere_task(sphere, 2, options), {});
  int close = 0;
  int close_flat = 0;
  int right_slopes = 0;
  for_each_sphere_pixel(view, 2, [&](int x, int y) {
    const double depth = sphere_depth(view, x, y);
    const PixelPlane& plane = planes.at(x, y);
    close_flat += std::abs(static_cast<double>(flat.depth.at(x, y)) - depth) < 0.01 ? 1 : 0;
    if (plane.inverse_depth == 0.0F || std::abs(1.0 / static_cast<double>(plane.inverse_depth) - depth) >= 0.01) return;
    ++close;
    const PlaneTrial truth = tangent_plane(view, x, y);
    const double tilt = std::hypot(truth.slope_x, truth.slope_y);
    const double error = std::hypot(plane.slope_x - truth.slope_x, plane.slope_y - truth.slope_y);
    right_slopes += error < 0.25 * tilt + 2e-4 ? 1 : 0;
  });
  EXPECT_GT(close, 1500);
  EXPECT_GT(close, close_flat + close_flat / 20);
  EXPECT_GT(right_slopes, close * 3 / 4);
}

TEST(RefinePlanes, NormalsAreThoseOfTheSphere) {
  const SphereScene sphere = make_sphere_scene(5, kRefineWidth, kRefineHeight, true, 3);
  const View& view = sphere.scene.views[2];
  const DepthMap map = sweep_depth(make_sphere_task(sphere, 2, {}), {});
  int seen = 0;
  int right = 0;
  for_each_sphere_pixel(view, 2, [&](int x, int y) {
    if (map.depth.at(x, y) == 0.0F) return;
    ++seen;
    const Eigen::Vector3d point = view.camera.to_camera(view.camera.unproject(x, y, sphere_depth(view, x, y)));
    const Eigen::Vector3d normal = (point - view.camera.to_camera(Eigen::Vector3d::Zero())).normalized();
    EXPECT_NEAR(map.normal.at(x, y).norm(), 1.0F, 1e-5);
    EXPECT_LT(map.normal.at(x, y).cast<double>().dot(point), 0.0) << "it faces the camera";
    right += normal.dot(map.normal.at(x, y).cast<double>()) > std::cos(0.3) ? 1 : 0;
  });
  EXPECT_GT(seen, 1500);
  EXPECT_GT(right, seen * 3 / 4);
  EXPECT_EQ(map.normal.at(0, 0), Eigen::Vector3f(0, 0, 0));
}

TEST(RefinePlanes, TilesThreadsAndInstructionsDoNotChangeTheBytes) {
  const SphereScene sphere = make_sphere_scene(4, kRefineWidth, kRefineHeight, true, 4);
  const SweepTask task = make_sphere_task(sphere, 1, {});
  const Grid<PixelPlane> expected = refined(task);
  for (const auto& [tile_width, tile_height] : {std::pair{8, 1}, {16, 64}, {37, 11}}) {
    for (const SimdLevel simd : simd_levels()) {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, tile_width == 16 ? 1 : 2);
      const Grid<PixelPlane> planes = refined(task, {simd, tile_width, tile_height});
      ASSERT_EQ(std::memcmp(planes.values.data(), expected.values.data(), sizeof(PixelPlane) * expected.values.size()),
                0);
    }
  }
}

TEST(RefinePlanes, NothingIsFoundWhereNothingCanBe) {
  SphereScene sphere = make_sphere_scene(4, kRefineWidth, kRefineHeight, false, 5);
  const auto expect_none = [](const SweepTask& task) {
    const DepthMap map = sweep_depth(task, {});
    for (const float depth : map.depth.values) ASSERT_EQ(depth, 0.0F);
  };
  SphereScene flat = sphere;
  for (ColorImage& image : flat.images) image = ColorImage(kRefineWidth, kRefineHeight, make_rgb(90, 90, 90));
  expect_none(make_sphere_task(flat, 1, {}));
  expect_none(
      make_sphere_task(make_sphere_scene(2, kRefineWidth, kRefineHeight, false, 5), 1, {}));  // one neighbor, two votes
  SweepTask empty = make_sphere_task(sphere, 1, {});
  for (PlaneRange& range : empty.ranges.values) range = {1, 0};
  expect_none(empty);
}

TEST(RefinePlanes, IdenticalPhotographsGiveNumbers) {
  SphereScene sphere = make_sphere_scene(4, kRefineWidth, kRefineHeight, false, 6);
  for (ColorImage& image : sphere.images) image = sphere.images[0];
  const DepthMap map = sweep_depth(make_sphere_task(sphere, 1, {}), {});
  for (std::size_t pixel = 0; pixel < map.depth.values.size(); ++pixel) {
    ASSERT_TRUE(std::isfinite(map.depth.values[pixel]));
    ASSERT_GE(map.depth.values[pixel], 0.0F);
    ASSERT_TRUE(map.confidence.values[pixel] >= 0.0F && map.confidence.values[pixel] <= 1.0F);
  }
}

}  // namespace
}  // namespace quorum
