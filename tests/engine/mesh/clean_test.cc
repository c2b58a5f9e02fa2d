#include "engine/mesh/clean.h"

#include <gtest/gtest.h>

#include <limits>

namespace quorum {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Vertex i lies at x = i, so that it can be found again, with this confidence.
Mesh mesh_of(const std::vector<float>& confidences, std::vector<Triangle> triangles) {
  Mesh mesh;
  for (const float confidence : confidences)
    mesh.vertices.push_back({.position = {static_cast<float>(mesh.vertices.size()), 0, 0}, .confidence = confidence});
  mesh.triangles = std::move(triangles);
  return mesh;
}

/// The triangles with the vertices of the mesh that was cleaned.
std::vector<Triangle> original_triangles(const Mesh& cleaned) {
  std::vector<Triangle> result;
  for (const Triangle& t : cleaned.triangles) {
    Triangle& original = result.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      original[i] = static_cast<std::uint32_t>(cleaned.vertices.at(t[i]).position.x());
  }
  return result;
}

std::vector<int> original_vertices(const Mesh& cleaned) {
  std::vector<int> result;
  for (const Vertex& vertex : cleaned.vertices) result.push_back(static_cast<int>(vertex.position.x()));
  return result;
}

CleanOptions options(float min_confidence, std::uint64_t min_triangles, bool largest = false) {
  return {.min_confidence = min_confidence, .min_component_triangles = min_triangles, .largest_component = largest};
}

/// Two strips: vertices 5..9 with three triangles, 0..3 with two; vertex 4 is of no triangle.
Mesh two_components() {
  return mesh_of(std::vector<float>(10, 1), {{5, 6, 7}, {0, 1, 2}, {6, 8, 7}, {2, 1, 3}, {8, 6, 9}});
}

TEST(Clean, TrianglesWithACornerOfLowConfidenceGo) {
  const Mesh mesh = mesh_of({1, 1, 1, 0.4F, 1}, {{0, 1, 2}, {1, 3, 2}, {2, 1, 4}});
  CleanCounts counts;
  const Mesh cleaned = clean(mesh, options(0.5F, 0), &counts);
  EXPECT_EQ(original_triangles(cleaned), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 4}}));
  EXPECT_EQ(original_vertices(cleaned), (std::vector<int>{0, 1, 2, 4}));
  EXPECT_EQ(counts.low_confidence_triangles, 1U);
  EXPECT_EQ(counts.low_confidence_vertices, 1U);
  EXPECT_EQ(counts.unreferenced_vertices, 0U);
}

TEST(Clean, ConfidenceIsJudgedBeforeComponents) {
  // Without the middle triangle each side is alone.
  const Mesh mesh = mesh_of({1, 1, 1, 0.1F, 1, 1}, {{0, 1, 2}, {2, 3, 4}, {3, 4, 5}, {4, 5, 2}});
  CleanCounts counts;
  const Mesh cleaned = clean(mesh, options(0.5F, 2), &counts);
  EXPECT_EQ(original_triangles(cleaned), (std::vector<Triangle>{{0, 1, 2}, {4, 5, 2}}));
  EXPECT_EQ(clean(mesh, options(0.5F, 3)).triangles, cleaned.triangles) << "all pieces are small";
}

TEST(Clean, SmallComponentsGoAndOrderStays) {
  CleanCounts counts;
  const Mesh cleaned = clean(two_components(), options(0, 3), &counts);
  EXPECT_EQ(original_triangles(cleaned), (std::vector<Triangle>{{5, 6, 7}, {6, 8, 7}, {8, 6, 9}}));
  EXPECT_EQ(original_vertices(cleaned), (std::vector<int>{5, 6, 7, 8, 9}));
  EXPECT_EQ(counts.small_component_triangles, 2U);
  EXPECT_EQ(counts.other_component_triangles, 0U);
  EXPECT_EQ(counts.unreferenced_vertices, 5U);
}

TEST(Clean, ComponentsGoThatAreASmallShareOfTheLargest) {
  CleanOptions by_share = options(0, 0);
  for (const auto& [share, kept] : {std::pair{0.0, 5U}, {0.66, 5U}, {0.67, 3U}, {1.0, 3U}}) {
    by_share.min_component_share = share;  // of the three triangles, where the other has two
    EXPECT_EQ(clean(two_components(), by_share).triangles.size(), kept) << share;
  }
  by_share.min_component_triangles = 4;
  EXPECT_EQ(clean(two_components(), by_share).triangles.size(), 5U) << "all pieces are small";
}

TEST(Clean, OnlyTheLargestComponentStaysIfWanted) {
  CleanCounts counts;
  const Mesh cleaned = clean(two_components(), options(0, 0, true), &counts);
  EXPECT_EQ(original_triangles(cleaned), (std::vector<Triangle>{{5, 6, 7}, {6, 8, 7}, {8, 6, 9}}));
  EXPECT_EQ(counts.other_component_triangles, 2U);
  EXPECT_EQ(counts.small_component_triangles, 0U);
}

TEST(Clean, OfEqualComponentsThatWithTheLowestVertexStays) {
  const Mesh mesh = mesh_of(std::vector<float>(9, 1), {{3, 5, 4}, {2, 1, 6}, {8, 7, 0}});
  EXPECT_EQ(original_triangles(clean(mesh, options(0, 0, true))), (std::vector<Triangle>{{8, 7, 0}}));
}

TEST(Clean, FilledTrianglesDoNotMakeAComponentLarge) {
  const Mesh mesh = mesh_of({1, 1, 1, 0, 0, 1, 1, 1, 1}, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {5, 6, 7}, {6, 7, 8}});
  EXPECT_EQ(original_triangles(clean(mesh, options(0, 2))), (std::vector<Triangle>{{5, 6, 7}, {6, 7, 8}}));
  EXPECT_EQ(clean(mesh, options(0, 1)).triangles.size(), 5U);
  EXPECT_EQ(clean(mesh, options(0, 0, true)).triangles.size(), 2U);
}

TEST(Clean, ThresholdsKeepWhatEqualsThem) {
  EXPECT_EQ(clean(mesh_of({0.5F, 1, 1}, {{0, 1, 2}}), options(0.5F, 1)).triangles.size(), 1U);
  EXPECT_EQ(clean(two_components(), options(1, 2)).triangles.size(), 5U);
  EXPECT_EQ(clean(two_components(), options(1, 3)).triangles.size(), 3U);
}

TEST(Clean, VerticesOfNoTriangleGo) {
  CleanCounts counts;
  EXPECT_EQ(original_vertices(clean(two_components(), options(0, 0), &counts)),
            (std::vector<int>{0, 1, 2, 3, 5, 6, 7, 8, 9}));
  EXPECT_EQ(counts.unreferenced_vertices, 1U);
}

TEST(Clean, OneTriangleIsAComponent) {
  const Mesh mesh = mesh_of({1, 1, 1}, {{0, 1, 2}});
  EXPECT_EQ(clean(mesh, options(0, 1, true)).triangles.size(), 1U);
  EXPECT_EQ(clean(mesh, options(0, 2, true)).triangles.size(), 1U) << "all pieces are small";
}

TEST(Clean, AnEmptyMeshStaysEmpty) {
  CleanCounts counts{.low_confidence_triangles = 7};
  const Mesh cleaned = clean(Mesh{}, options(0.5F, 10, true), &counts);
  EXPECT_TRUE(cleaned.vertices.empty() && cleaned.triangles.empty());
  EXPECT_EQ(counts.low_confidence_triangles, 0U);
}

TEST(Clean, ACloudLosesItsUnsureVerticesAndNothingElse) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CleanCounts counts;
  const Mesh cleaned = clean(mesh_of({1, 0.2F, 0.5F, nan, 3}, {}), options(0.5F, 100, true), &counts);
  EXPECT_EQ(original_vertices(cleaned), (std::vector<int>{0, 2, 4}));
  EXPECT_EQ(counts.low_confidence_vertices, 2U);
  EXPECT_EQ(counts.unreferenced_vertices, 0U);
}

TEST(Clean, EveryLossIsCountedOnce) {
  Mesh mesh = two_components();
  mesh.vertices[9].confidence = 0;
  mesh.vertices[3].confidence = 0;
  CleanCounts counts;
  const Mesh cleaned = clean(mesh, options(0.5F, 2, true), &counts);
  EXPECT_EQ(cleaned.triangles.size() + counts.low_confidence_triangles + counts.small_component_triangles +
                counts.other_component_triangles,
            mesh.triangles.size());
  EXPECT_EQ(cleaned.vertices.size() + counts.low_confidence_vertices + counts.unreferenced_vertices,
            mesh.vertices.size());
  EXPECT_EQ(counts.low_confidence_triangles, 2U);
  EXPECT_EQ(counts.small_component_triangles, 1U);
}

TEST(AutomaticMinConfidence, IsAnEighthOfTheMedianUpToALimit) {
  const auto with_confidences = [](std::vector<float> confidences) {
    Mesh mesh;
    for (const float confidence : confidences) {
      mesh.vertices.emplace_back();
      mesh.vertices.back().confidence = confidence;
    }
    return automatic_min_confidence(mesh.vertices);
  };
  EXPECT_FLOAT_EQ(with_confidences({0.9F, 0.08F, 0.01F}), 0.01F);
  EXPECT_FLOAT_EQ(with_confidences({0.16F}), 0.02F);
  EXPECT_FLOAT_EQ(with_confidences({5.0F, 5.0F, 0.01F}), 0.045F);
  EXPECT_EQ(with_confidences({}), 0.0F);
}

}  // namespace
}  // namespace quorum
