#include "engine/evaluate/evaluate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace quorum {
namespace {

/// A grid of columns × rows squares of side `step`, from the origin along x and y, at height z.
Mesh plane(int columns, int rows, float step, float z) {
  Mesh mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x)
      mesh.vertices.push_back({.position = {step * static_cast<float>(x), step * static_cast<float>(y), z}});
  const auto width = static_cast<std::uint32_t>(columns) + 1;
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(rows); ++y)
    for (std::uint32_t x = 0; x + 1 < width; ++x) {
      const std::uint32_t corner = y * width + x;
      mesh.triangles.push_back({corner, corner + 1, corner + width});
      mesh.triangles.push_back({corner + 1, corner + width + 1, corner + width});
    }
  return mesh;
}

/// A plane rolled into a sphere: 4 n columns of longitude, 2 n rows of latitude.
Mesh sphere(double radius, int n) {
  Mesh mesh = plane(4 * n, 2 * n, 1, 0);
  for (Vertex& vertex : mesh.vertices) {
    const double longitude = vertex.position.x() * std::numbers::pi / (2 * n);
    const double latitude = vertex.position.y() * std::numbers::pi / (2 * n);
    vertex.position = (radius * Eigen::Vector3d(std::sin(latitude) * std::cos(longitude),
                                                std::sin(latitude) * std::sin(longitude), std::cos(latitude)))
                          .cast<float>();
  }
  return mesh;
}

Mesh cloud_along_x(const std::vector<float>& positions) {
  Mesh cloud;
  for (const float x : positions) cloud.vertices.push_back({.position = {x, 0, 0}});
  return cloud;
}

EvaluateOptions options_in(double unit) {
  EvaluateOptions options;
  options.threshold = 0.00125 * unit;
  options.cap = 0.025 * unit;
  options.distances = {0.00025 * unit, 0.0005 * unit, 0.00125 * unit};
  options.samples = 20000;
  return options;
}

TEST(Evaluate, ParallelPlanesAreTheirDistanceApart) {
  const Evaluation result = evaluate(plane(10, 10, 0.1F, 0.001F), plane(3, 3, 1.0F / 3, 0), options_in(1)).value();
  EXPECT_NEAR(result.accuracy, 0.001, 1e-7);
  EXPECT_NEAR(result.median_accuracy, 0.001, 1e-7);
  EXPECT_NEAR(result.mean_accuracy, 0.001, 1e-7);
  EXPECT_EQ(result.completeness, 1);
  ASSERT_EQ(result.f_scores.size(), 3U);
  EXPECT_EQ(result.f_scores[1].f, 0);
  EXPECT_EQ(result.f_scores[2].distance, 0.00125);
  EXPECT_EQ(result.f_scores[2].f, 1);
}

TEST(Evaluate, ConcentricSpheresDifferByTheirRadii) {
  const Evaluation result = evaluate(sphere(1.01, 64), sphere(1, 64), options_in(1)).value();
  const double sagitta = 1 - std::cos(std::numbers::pi / 256);
  EXPECT_NEAR(result.accuracy, 0.01, 2 * sagitta);
  EXPECT_NEAR(result.mean_accuracy, 0.01, 2 * sagitta);
  EXPECT_EQ(result.completeness, 0);
}

TEST(Evaluate, HalfAPlaneIsHalfComplete) {
  const Mesh truth = plane(10, 10, 0.1F, 0);
  const Evaluation result = evaluate(plane(5, 10, 0.1F, 0), truth, options_in(1)).value();
  EXPECT_NEAR(result.accuracy, 0, 1e-7);
  EXPECT_NEAR(result.completeness, 0.5 + 0.00125, 5e-4);  // the threshold reaches past the rim
  EXPECT_NEAR(result.f_scores[2].precision, 1, 0);
  EXPECT_NEAR(result.f_scores[2].f, 2 * 0.50125 / 1.50125, 5e-4);
  const Evaluation swapped = evaluate(truth, plane(5, 10, 0.1F, 0), options_in(1)).value();
  EXPECT_EQ(swapped.completeness, 1);
  EXPECT_NEAR(swapped.accuracy, 0.4, 1e-3);
}

TEST(Evaluate, AccuracyIsTheDistanceThatHoldsTheShare) {
  const Mesh reconstruction = cloud_along_x({7, 1, 9, 3, 5, 10, 2, 8, 4, 6});
  EvaluateOptions options;
  const auto accuracy_at = [&](double share) {
    options.share = share;
    return evaluate(reconstruction, cloud_along_x({0}), options).value().accuracy;
  };
  EXPECT_EQ(accuracy_at(0.9), 9);
  EXPECT_EQ(accuracy_at(0.91), 10);
  EXPECT_EQ(accuracy_at(0.3), 3);
  EXPECT_EQ(accuracy_at(1), 10);
  EXPECT_EQ(accuracy_at(0), 1);
  const Evaluation result = evaluate(reconstruction, cloud_along_x({0}), options).value();
  EXPECT_EQ(result.median_accuracy, 5);
}

TEST(Evaluate, TheMeanCountsDistancesUpToTheCap) {
  const Mesh reconstruction = cloud_along_x({7, 1, 9, 3, 5, 10, 2, 8, 4, 6});
  EvaluateOptions options;
  options.cap = 100;
  EXPECT_EQ(evaluate(reconstruction, cloud_along_x({0}), options).value().mean_accuracy, 5.5);
  options.cap = 3;
  EXPECT_EQ(evaluate(reconstruction, cloud_along_x({0}), options).value().mean_accuracy, 2.7);
}

TEST(Evaluate, PiecesAndFarVerticesAreCounted) {
  Mesh mesh = plane(2, 2, 0.5F, 0);
  const Mesh far = plane(1, 1, 0.1F, 0.5F);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), far.vertices.begin(), far.vertices.end());
  for (const auto& [a, b, c] : far.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  const Evaluation result = evaluate(mesh, plane(1, 1, 1, 0), options_in(1)).value();
  EXPECT_EQ(result.components, 2U);
  EXPECT_EQ(result.vertices, 13U);
  EXPECT_EQ(result.far_vertices, 4U);
  EXPECT_EQ(evaluate(cloud_along_x({0, 1, 2}), cloud_along_x({0}), {}).value().components, 3U);
}

/// Views side by side that look along z at the unit square.
Scene views_before_the_square(int count) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    View& view = scene.views.emplace_back();
    view.width = view.height = 201;
    view.camera.intrinsics << 200, 0, 100, 0, 200, 100, 0, 0, 1;
    view.camera.translation = {-0.5 - 0.01 * i, -0.5, 2};
  }
  return scene;
}

TEST(Evaluate, TheTruthThatTooFewViewsSeeDoesNotCount) {
  Mesh truth = plane(4, 4, 0.25F, 0);
  const Mesh hidden = plane(4, 4, 0.25F, 0.1F);
  for (const auto& [a, b, c] : hidden.triangles) truth.triangles.push_back({a + 25, b + 25, c + 25});
  truth.vertices.insert(truth.vertices.end(), hidden.vertices.begin(), hidden.vertices.end());
  const Mesh front = plane(4, 4, 0.25F, 0);
  const Scene scene = views_before_the_square(3);
  EvaluateOptions options = options_in(1);
  EXPECT_NEAR(evaluate(front, truth, options).value().completeness, 0.5, 1e-3);
  const Evaluation seen = evaluate(front, truth, options, &scene).value();
  EXPECT_GT(seen.completeness, 0.98) << "a rim of what is hidden is seen from aside";
  EXPECT_NEAR(seen.seen_share, 0.5, 0.02);
  options.hidden_by = 0.2;  // the front does not count as standing before what is so close
  EXPECT_NEAR(evaluate(front, truth, options, &scene).value().completeness, 0.5, 0.03);
  options.hidden_by = 0.0002;
  options.seen_by = 4;
  const auto unseen = evaluate(front, truth, options, &scene);
  ASSERT_FALSE(unseen);
  EXPECT_NE(unseen.error().message.find("no 4 views"), std::string::npos) << unseen.error().message;
  options.seen_by = 0;
  EXPECT_NEAR(evaluate(front, truth, options, &scene).value().completeness, 0.5, 1e-3);
}

TEST(Evaluate, WhatLiesBesideAnImageOrBehindACameraIsNotSeen) {
  Scene scene = views_before_the_square(3);
  for (View& view : scene.views) view.width = 101;  // the left half
  EXPECT_NEAR(evaluate(plane(1, 1, 1, 0), plane(1, 1, 1, 0), options_in(1), &scene).value().seen_share, 0.5, 0.02);
  for (View& view : scene.views) view.camera.translation.z() = -2;
  EXPECT_FALSE(evaluate(plane(1, 1, 1, 0), plane(1, 1, 1, 0), options_in(1), &scene));
}

TEST(Evaluate, AShareOfSevenHundredthsIsSevenOfAHundred) {
  std::vector<float> positions(100);
  std::iota(positions.begin(), positions.end(), 1.0F);
  EvaluateOptions options;
  options.share = 0.07;
  ASSERT_GT(options.share * 100, 7) << "rounding does not bite";
  EXPECT_EQ(evaluate(cloud_along_x(positions), cloud_along_x({0}), options).value().accuracy, 7);
}

TEST(Evaluate, PrecisionRecallAndFAreAsCountedByHand) {
  EvaluateOptions options;
  options.distances = {0.25, 0.5, 4};
  options.threshold = 0.5;
  // To the truth: 0, 0.5, 3, 7. To the reconstruction: 0, 0.5.
  const Evaluation result = evaluate(cloud_along_x({0, 1.5F, 4, 8}), cloud_along_x({0, 1}), options).value();
  ASSERT_EQ(result.f_scores.size(), 3U);
  EXPECT_EQ(result.f_scores[0].precision, 0.25);
  EXPECT_EQ(result.f_scores[0].recall, 0.5);
  EXPECT_DOUBLE_EQ(result.f_scores[0].f, 1.0 / 3);
  EXPECT_EQ(result.f_scores[1].precision, 0.5);
  EXPECT_EQ(result.f_scores[1].recall, 1);
  EXPECT_DOUBLE_EQ(result.f_scores[1].f, 2.0 / 3);
  EXPECT_EQ(result.f_scores[2].precision, 0.75);
  EXPECT_EQ(result.completeness, 1);
}

TEST(Evaluate, ACloudIsMeasuredToTheTrianglesOfAMesh) {
  Mesh cloud = plane(7, 7, 0.1F, 0.002F);
  cloud.triangles.clear();
  const Evaluation result = evaluate(cloud, plane(1, 1, 1, 0), options_in(1)).value();
  EXPECT_NEAR(result.accuracy, 0.002, 1e-8);
  EXPECT_EQ(result.completeness, 0) << "the truth is seldom near a point";
}

TEST(Evaluate, OneTriangleIsAccurateAndCompleteAgainstItself) {
  Mesh triangle = plane(1, 1, 1, 0);
  triangle.triangles.resize(1);
  const Evaluation result = evaluate(triangle, triangle, options_in(1)).value();
  EXPECT_LT(result.accuracy, 1e-12);
  EXPECT_EQ(result.completeness, 1);
  EXPECT_EQ(result.f_scores[0].f, 1);
}

TEST(Evaluate, ResultsFollowTheUnitOfTheScene) {
  const auto spheres_in = [](double unit) {
    return evaluate(sphere(1.001 * unit, 32), sphere(unit, 32), options_in(unit)).value();
  };
  const Evaluation meters = spheres_in(1);
  EXPECT_GT(meters.accuracy, 0.0005);
  for (const double unit : {1e-6, 1e3}) {
    const Evaluation result = spheres_in(unit);
    EXPECT_NEAR(result.accuracy / unit, meters.accuracy, 1e-6);
    EXPECT_NEAR(result.mean_accuracy / unit, meters.mean_accuracy, 1e-6);
    EXPECT_NEAR(result.completeness, meters.completeness, 1e-3);
    EXPECT_NEAR(result.f_scores[2].f, meters.f_scores[2].f, 1e-3);
  }
}

TEST(Evaluate, OneThreadGivesTheSameResult) {
  const auto run = [] { return evaluate(sphere(1.003, 32), sphere(1, 24), options_in(1)).value(); };
  const Evaluation parallel = run();
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const Evaluation serial = run();
  EXPECT_EQ(parallel.accuracy, serial.accuracy);
  EXPECT_EQ(parallel.mean_accuracy, serial.mean_accuracy);
  EXPECT_EQ(parallel.completeness, serial.completeness);
}

TEST(Evaluate, AnEmptyOrBrokenSideIsNamed) {
  const Mesh one = cloud_along_x({0});
  const auto no_reconstruction = evaluate(Mesh{}, one, {});
  ASSERT_FALSE(no_reconstruction.has_value());
  EXPECT_EQ(no_reconstruction.error().kind, ErrorKind::kInput);
  EXPECT_EQ(no_reconstruction.error().message.find("reconstruction: "), 0U);
  const auto no_truth = evaluate(one, Mesh{}, {});
  ASSERT_FALSE(no_truth.has_value());
  EXPECT_EQ(no_truth.error().message.find("truth: "), 0U);
  const auto broken = evaluate(cloud_along_x({0, std::numeric_limits<float>::infinity()}), one, {});
  ASSERT_FALSE(broken.has_value());
  EXPECT_EQ(broken.error().kind, ErrorKind::kInput);
}

TEST(EvaluateOptions, WhatIsOutOfRangeIsNamed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const auto& change) {
    EvaluateOptions options;
    change(options);
    const auto result = evaluate(cloud_along_x({0}), cloud_along_x({0}), options);
    return result ? std::string("accepted") : result.error().message.substr(0, result.error().message.find(' ', 7));
  };
  EXPECT_EQ(message([](EvaluateOptions&) {}), "accepted");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.share = 1.1; }), "option share");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.share = -0.1; }), "option share");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.share = kNan; }), "option share");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.threshold = 0; }), "option threshold");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.distances = {1, kNan}; }), "option distances");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.distances = {}; }), "accepted");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.cap = 0; }), "option cap");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.hidden_by = kNan; }), "option hidden-by");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.seen_by = -1; }), "option seen-by");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.samples = 0; }), "option samples");
  EXPECT_EQ(message([](EvaluateOptions& o) { o.samples = 100'000'001; }), "option samples");
}

}  // namespace
}  // namespace quorum
