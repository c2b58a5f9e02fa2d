#include <gtest/gtest.h>

#include <cmath>

#include "engine/texture/blend_band.h"

namespace quorum {
namespace {

constexpr int kSide = 12;  // squares along a side

/// A plane of squares; the left half is taken from view 0, the right one from view 1.
struct TwoPatches {
  Mesh mesh;
  std::vector<std::int32_t> views;
  MeshLinks links;
  PatchVertices patch_vertices;

  TwoPatches() {
    for (int y = 0; y <= kSide; ++y)
      for (int x = 0; x <= kSide; ++x)
        mesh.vertices.push_back({.position = {static_cast<float>(x), static_cast<float>(y), 0}});
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const auto at = [&](int dx, int dy) { return static_cast<std::uint32_t>((y + dy) * (kSide + 1) + x + dx); };
        mesh.triangles.push_back({at(0, 0), at(1, 0), at(0, 1)});
        mesh.triangles.push_back({at(1, 0), at(1, 1), at(0, 1)});
        views.insert(views.end(), 2, x < kSide / 2 ? 0 : 1);
      }
    links = link_mesh(mesh);
    patch_vertices = make_patch_vertices(links, views);
  }

  [[nodiscard]] std::uint32_t vertex(int x, int y) const { return static_cast<std::uint32_t>(y * (kSide + 1) + x); }
};

TEST(PatchVertices, ThoseAtASeamAreThereOnceAView) {
  const TwoPatches two;
  EXPECT_EQ(two.patch_vertices.views.size(), two.mesh.vertices.size() + kSide + 1);
  EXPECT_TRUE(two.patch_vertices.is_on_seam(two.vertex(kSide / 2, 3)));
  EXPECT_FALSE(two.patch_vertices.is_on_seam(two.vertex(kSide / 2 - 1, 3)));
  EXPECT_EQ(two.patch_vertices.views[two.patch_vertices.find(two.vertex(kSide / 2, 3), 1)], 1);
}

TEST(LevelSeams, APhotographThatIsBrighterMeetsTheOtherHalfWay) {
  const TwoPatches two;
  std::vector<LevelShift> colors(two.patch_vertices.views.size());
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i].fill(two.patch_vertices.views[i] == 0 ? 100.0F : 130.0F);
  const std::vector<LevelShift> no_mean(colors.size());
  const auto shifts = level_seams(two.mesh, two.views, two.patch_vertices, colors, no_mean);
  const auto shift = [&](int x, std::int32_t view) {
    return shifts[two.patch_vertices.find(two.vertex(x, kSide / 2), view)][1];
  };
  const float step_before = 30;
  const float step = step_before + shift(kSide / 2, 1) - shift(kSide / 2, 0);
  EXPECT_LT(std::abs(step), 2);
  EXPECT_NEAR(shift(kSide / 2, 0), -shift(kSide / 2, 1), 0.1);
  EXPECT_GT(shift(kSide / 2, 0), 10);
  EXPECT_LT(shift(0, 0), shift(kSide / 2, 0));  // it fades away from the seam
}

TEST(LevelSeams, ColorsThatFitStayWhereTheyAre) {
  const TwoPatches two;
  const std::vector<LevelShift> colors(two.patch_vertices.views.size(), LevelShift{50, 60, 70});
  const auto shifts =
      level_seams(two.mesh, two.views, two.patch_vertices, colors, std::vector<LevelShift>(colors.size()));
  for (const LevelShift& shift : shifts) EXPECT_EQ(shift, (LevelShift{0, 0, 0}));
}

TEST(LevelSeams, APatchFollowsTheMeanOfAllPhotographs) {
  const TwoPatches two;
  const std::vector<LevelShift> colors(two.patch_vertices.views.size());
  const std::vector<LevelShift> to_mean(colors.size(), LevelShift{8, -4, 0});
  const auto shifts = level_seams(two.mesh, two.views, two.patch_vertices, colors, to_mean);
  for (const LevelShift& shift : shifts) {
    EXPECT_NEAR(shift[0], 8, 0.1);
    EXPECT_NEAR(shift[1], -4, 0.1);
  }
}

TEST(BlendBand, SharesAreEqualAtTheSeamAndFallToNothing) {
  const TwoPatches two;
  Candidates candidates(two.mesh.triangles.size());
  for (std::size_t t = 0; t < two.mesh.triangles.size(); ++t)
    for (const std::uint32_t view : {0U, 1U}) candidates.add(t, {.quality = 1, .view = view});
  const std::vector<LevelShift> shifts(two.patch_vertices.views.size());
  const auto parts = blend_band(two.mesh, two.links, two.views, two.patch_vertices, shifts, candidates, 3);
  ASSERT_FALSE(parts.empty());
  for (const BlendPart& part : parts) {
    EXPECT_NE(part.view, two.views[part.triangle]);
    for (int corner = 0; corner < 3; ++corner) {
      const float x = two.mesh.vertices[two.mesh.triangles[part.triangle][corner]].position.x();
      const float distance = std::abs(x - kSide / 2);
      EXPECT_NEAR(part.shares[corner], std::max(0.0F, 0.5F * (1 - distance / 3)), 1e-6) << x;
    }
  }
  EXPECT_TRUE(blend_band(two.mesh, two.links, two.views, two.patch_vertices, shifts, candidates, 0).empty());
}

}  // namespace
}  // namespace quorum
