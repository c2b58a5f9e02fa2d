#include "engine/texture/choose_views.h"

#include <gtest/gtest.h>

namespace quorum {
namespace {

/// A strip of triangles, each beside the last one.
Mesh strip(std::uint32_t triangles) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < triangles + 2; ++i)
    mesh.vertices.push_back({.position = {static_cast<float>(i / 2), static_cast<float>(i % 2), 0}});
  for (std::uint32_t t = 0; t < triangles; ++t)
    mesh.triangles.push_back(t % 2 == 0 ? std::array{t, t + 2, t + 1} : std::array{t, t + 1, t + 2});
  return mesh;
}

double nowhere(std::uint32_t /*triangle*/, std::int32_t /*view*/) { return -1; }

TEST(MeshLinks, TrianglesOfAStripHaveTheirNeighbors) {
  const MeshLinks links = link_mesh(strip(5));
  const auto& of_third = links.neighbors[2];
  EXPECT_EQ(std::ranges::count(of_third, 1U), 1);
  EXPECT_EQ(std::ranges::count(of_third, 3U), 1);
  EXPECT_EQ(std::ranges::count(of_third, kNoTriangle), 1);
  EXPECT_EQ(links.around_vertex(2).size(), 3U);
}

TEST(MeshLinks, AnEdgeOfThreeTrianglesMakesNoNeighbors) {
  Mesh mesh = strip(2);
  mesh.vertices.push_back({.position = {0, 0, 1}});
  mesh.triangles.push_back({1, 2, 4});
  const MeshLinks links = link_mesh(mesh);
  for (const auto& neighbors : links.neighbors) EXPECT_EQ(std::ranges::count(neighbors, kNoTriangle), 3);
}

TEST(Candidates, KeepTheBestInOrder) {
  Candidates candidates(1);
  for (const float quality : {3.0F, 9.0F, 1.0F, 7.0F, 5.0F, 2.0F, 8.0F, 6.0F, 4.0F, 9.0F})
    candidates.add(0, {.quality = quality, .view = static_cast<std::uint32_t>(quality)});
  std::vector<float> kept;
  for (const Candidate& candidate : candidates.of(0)) kept.push_back(candidate.quality);
  EXPECT_EQ(kept, (std::vector<float>{9, 9, 8, 7, 6, 5, 4, 3}));
}

TEST(Candidates, ThePhotographThatIsAloneWithItsColorDisagrees) {
  Candidates candidates(2);
  for (std::uint32_t view = 0; view < 5; ++view)
    for (std::size_t triangle : {0U, 1U}) {
      const auto level = static_cast<std::uint8_t>(view == 2 ? 240 : 100 + view);
      if (triangle == 0 || view < 3) candidates.add(triangle, {.quality = 1, .view = view, .color = {level, 100, 100}});
    }
  mark_disagreement(candidates);
  EXPECT_EQ(candidates.find(0, 2), nullptr);
  EXPECT_NE(candidates.find(0, 3), nullptr);
  EXPECT_NE(candidates.find(1, 2), nullptr);  // three are too few to tell
}

TEST(ChooseViews, ASlightlyBetterPhotographDoesNotSplitAPatch) {
  const Mesh mesh = strip(60);
  Candidates candidates(60);
  for (std::size_t t = 0; t < 60; ++t) {
    candidates.add(t, {.quality = 10, .view = 1});
    candidates.add(t, {.quality = t == 30 ? 12.0F : 8.0F, .view = 2});
  }
  const auto views = choose_views(link_mesh(mesh), candidates, nowhere);
  EXPECT_EQ(std::ranges::count(views, 1), 60);
}

TEST(ChooseViews, AMuchBetterPhotographIsTaken) {
  const Mesh mesh = strip(60);
  Candidates candidates(60);
  for (std::size_t t = 0; t < 60; ++t) {
    candidates.add(t, {.quality = t < 30 ? 10.0F : 1.0F, .view = 1});
    candidates.add(t, {.quality = t < 30 ? 1.0F : 10.0F, .view = 2});
  }
  const auto views = choose_views(link_mesh(mesh), candidates, nowhere);
  EXPECT_EQ(views.front(), 1);
  EXPECT_EQ(views.back(), 2);
  EXPECT_NEAR(static_cast<double>(std::ranges::count(views, 1)), 30, 6);
}

TEST(ChooseViews, WithoutCandidatesATriangleIsUnseen) {
  const Mesh mesh = strip(20);
  Candidates candidates(20);
  for (std::size_t t = 0; t < 10; ++t) candidates.add(t, {.quality = 1, .view = 4});
  const auto views = choose_views(link_mesh(mesh), candidates, nowhere);
  EXPECT_EQ(std::ranges::count(views, 4), 10);
  EXPECT_EQ(std::ranges::count(views, kUnseen), 10);
}

TEST(ChooseViews, AHiddenSpeckTakesThePatchAroundItIfItFacesThePhotograph) {
  const Mesh mesh = strip(20);
  Candidates candidates(20);
  for (std::size_t t = 0; t < 20; ++t) candidates.add(t, {.quality = 1, .view = t == 10 ? 5U : 4U});
  EXPECT_EQ(choose_views(link_mesh(mesh), candidates, nowhere)[10], 5);
  const auto facing = [](std::uint32_t, std::int32_t) { return 2.0; };
  EXPECT_EQ(choose_views(link_mesh(mesh), candidates, facing)[10], 4);
}

}  // namespace
}  // namespace quorum
