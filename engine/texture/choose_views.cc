#include "engine/texture/choose_views.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "engine/mesh/disjoint_sets.h"

namespace quorum {
namespace {

constexpr int kFull = 65535;
constexpr int kEnough = kFull * 6 / 10;  // a share from which on a view is as good as the best one

/// Of each candidate of a triangle, 0..kFull; 0 for those that disagree.
using Shares = std::vector<std::array<std::uint16_t, Candidates::kMost>>;

Shares first_shares(const Candidates& candidates) {
  Shares shares(candidates.triangles());
  tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t t) {
    const auto of = candidates.of(t);
    float best = 0;
    for (const Candidate& candidate : of) best = candidate.disagrees ? best : std::max(best, candidate.quality);
    for (std::size_t i = 0; i < of.size(); ++i)
      shares[t][i] = of[i].disagrees ? 0 : static_cast<std::uint16_t>(of[i].quality / best * kFull);
  });
  return shares;
}

/// What the candidate's view has gathered at another triangle.
int share_at(const Candidates& candidates, const Shares& shares, std::uint32_t triangle, std::uint32_t view) {
  const auto of = candidates.of(triangle);
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i].view == view) return shares[triangle][i];
  return 0;
}

/// One step: two parts of its own, one of each neighbor.
Shares spread(const MeshLinks& links, const Candidates& candidates, const Shares& shares) {
  Shares spread(shares.size());
  tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t t) {
    const auto of = candidates.of(t);
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (of[i].disagrees) continue;
      int sum = 2 * shares[t][i];
      for (const std::uint32_t neighbor : links.neighbors[t])
        sum += neighbor == kNoTriangle ? shares[t][i] : share_at(candidates, shares, neighbor, of[i].view);
      spread[t][i] = static_cast<std::uint16_t>(sum / 5);
    }
  });
  return spread;
}

/// The candidate of the highest sum of share and bonus; kUnseen if there is none.
template <typename Bonus>
std::int32_t best_view(const Candidates& candidates, const Shares& shares, std::size_t triangle, const Bonus& bonus) {
  std::int32_t best = kUnseen;
  int most = -1;
  const auto of = candidates.of(triangle);
  for (std::size_t i = 0; i < of.size(); ++i) {
    const int worth = of[i].disagrees
                          ? -1
                          : std::min<int>(shares[triangle][i], kEnough) + bonus(static_cast<std::int32_t>(of[i].view));
    if (worth <= most) continue;
    most = worth;
    best = static_cast<std::int32_t>(of[i].view);
  }
  return best;
}

/// Triangles for which each view is good enough.
std::vector<std::vector<std::uint32_t>> good_triangles(const Candidates& candidates, const Shares& shares) {
  std::vector<std::vector<std::uint32_t>> good;
  for (std::uint32_t t = 0; t < shares.size(); ++t) {
    const auto of = candidates.of(t);
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (shares[t][i] < kEnough) continue;
      if (good.size() <= of[i].view) good.resize(of[i].view + 1);
      good[of[i].view].push_back(t);
    }
  }
  return good;
}

/// Again and again the view that is good enough for most triangles that have none yet, for these.
void cover(const Candidates& candidates, const Shares& shares, std::vector<std::int32_t>& views) {
  const auto good = good_triangles(candidates, shares);
  std::vector<std::size_t> left;
  for (const auto& triangles : good) left.push_back(triangles.size());
  while (!left.empty()) {
    const auto most = std::ranges::max_element(left);
    if (*most == 0) break;
    const auto view = static_cast<std::size_t>(most - left.begin());
    for (const std::uint32_t t : good[view]) {
      if (views[t] != kUnseen) continue;
      views[t] = static_cast<std::int32_t>(view);
      const auto of = candidates.of(t);
      for (std::size_t i = 0; i < of.size(); ++i)
        if (shares[t][i] >= kEnough) --left[of[i].view];
    }
  }
}

/// One triangle after the other: worth is its share, as far as that counts, and an eighth of a full one for each
/// neighbor with the same view.
void settle_in_turn(const MeshLinks& links, const Candidates& candidates, const Shares& shares,
                    std::vector<std::int32_t>& views) {
  for (std::size_t t = 0; t < views.size(); ++t)
    views[t] = best_view(candidates, shares, t, [&](std::int32_t view) {
      int same = 0;
      for (const std::uint32_t neighbor : links.neighbors[t])
        same += neighbor != kNoTriangle && views[neighbor] == view ? 1 : 0;
      return same * (kFull / 8);
    });
}

/// The triangles of each patch that has fewer than most, under its lowest one.
std::map<std::uint32_t, std::vector<std::uint32_t>> small_patches(const MeshLinks& links,
                                                                  const std::vector<std::int32_t>& views,
                                                                  std::uint32_t most) {
  DisjointSets sets(views.size());
  for (std::uint32_t t = 0; t < views.size(); ++t)
    for (const std::uint32_t neighbor : links.neighbors[t])
      if (neighbor != kNoTriangle && neighbor < t && views[neighbor] == views[t]) sets.join(t, neighbor);
  std::vector<std::uint32_t> sizes(views.size());
  for (std::uint32_t t = 0; t < views.size(); ++t) ++sizes[sets.find(t)];
  std::map<std::uint32_t, std::vector<std::uint32_t>> patches;
  for (std::uint32_t t = 0; t < views.size(); ++t)
    if (const std::uint32_t lowest = sets.find(t); views[t] != kUnseen && sizes[lowest] < most)
      patches[lowest].push_back(t);
  return patches;
}

/// Views beside a patch, those with the longest border first.
std::vector<std::int32_t> views_beside(const MeshLinks& links, const std::vector<std::int32_t>& views,
                                       const std::vector<std::uint32_t>& patch) {
  std::map<std::int32_t, int> edges;
  for (const std::uint32_t t : patch)
    for (const std::uint32_t neighbor : links.neighbors[t])
      if (neighbor != kNoTriangle && views[neighbor] != views[t] && views[neighbor] != kUnseen)
        ++edges[views[neighbor]];
  std::vector<std::int32_t> order;
  for (const auto& [view, count] : edges) order.push_back(view);
  std::ranges::stable_sort(order, [&](std::int32_t a, std::int32_t b) { return edges[a] > edges[b]; });
  return order;
}

/// Whether a view may take a patch: it shows all of it well enough, or it is too small for that to be seen.
bool may_take(const Candidates& candidates, const Shares& shares, const FacingPixels& facing,
              const std::vector<std::uint32_t>& patch, std::int32_t view) {
  constexpr double kFewPixels = 16;
  bool is_shown = true;
  std::int64_t sum = 0;
  for (const std::uint32_t t : patch) {
    const auto wanted = static_cast<std::uint32_t>(view);
    is_shown = is_shown && candidates.find(t, wanted) != nullptr;
    sum += share_at(candidates, shares, t, wanted);
  }
  if (is_shown && sum >= std::int64_t{kEnough} * 2 / 3 * static_cast<std::int64_t>(patch.size())) return true;
  double pixels = 0;
  for (const std::uint32_t t : patch) {
    const double more = facing(t, view);
    pixels += more;
    if (more < 0 || pixels > kFewPixels) return false;
  }
  return true;
}

void join_small_patches(const MeshLinks& links, const Candidates& candidates, const Shares& shares,
                        const FacingPixels& facing, std::uint32_t most, std::vector<std::int32_t>& views) {
  for (const auto& [lowest, patch] : small_patches(links, views, most))
    for (const std::int32_t view : views_beside(links, views, patch)) {
      if (!may_take(candidates, shares, facing, patch, view)) continue;
      for (const std::uint32_t t : patch) views[t] = view;
      break;
    }
}

}  // namespace

std::vector<std::int32_t> choose_views(const MeshLinks& links, const Candidates& candidates,
                                       const FacingPixels& facing) {
  constexpr int kSpreads = 24;
  constexpr int kTurns = 4;
  Shares shares = first_shares(candidates);
  for (int i = 0; i < kSpreads; ++i) shares = spread(links, candidates, shares);
  // What has gathered, as shares of the best again.
  for (auto& of_triangle : shares)
    if (const int best = std::ranges::max(of_triangle); best > 0)
      for (std::uint16_t& share : of_triangle)
        share =
            static_cast<std::uint16_t>(std::uint32_t{share} * std::uint32_t{kFull} / static_cast<std::uint32_t>(best));
  std::vector<std::int32_t> views(candidates.triangles(), kUnseen);
  cover(candidates, shares, views);
  for (int i = 0; i < kTurns; ++i) settle_in_turn(links, candidates, shares, views);
  for (const std::uint32_t most : {4U, 12U, 48U, 192U})
    join_small_patches(links, candidates, shares, facing, most, views);
  return views;
}

}  // namespace quorum
