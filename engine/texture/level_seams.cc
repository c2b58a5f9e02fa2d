// Global leveling of seams; declared and described in engine/texture/patch_vertices.h.
#include <utility>

#include "engine/texture/patch_vertices.h"

namespace quorum {
namespace {

constexpr double kSeamWeight = 16;
constexpr double kEdgeWeight = 0.5;  // an edge between two triangles of a patch is met twice
constexpr double kMeanWeight = 0.3;

/// Three unknowns a patch vertex, one a channel.
using Shifts = std::vector<std::array<double, 3>>;

struct Link {
  std::uint32_t a;
  std::uint32_t b;
};

struct LevelSystem {
  std::vector<Link> edges;  ///< within patches
  std::vector<Link> seams;
  std::vector<double> diagonal;

  LevelSystem(const Mesh& mesh, const std::vector<std::int32_t>& views, const PatchVertices& patch_vertices)
      : diagonal(patch_vertices.views.size(), kMeanWeight) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (views[t] == kUnseen) continue;
      std::array<std::uint32_t, 3> places{};
      for (int i = 0; i < 3; ++i) places[i] = patch_vertices.find(mesh.triangles[t][i], views[t]);
      for (int i = 0; i < 3; ++i) add(edges, {places[i], places[(i + 1) % 3]}, kEdgeWeight);
    }
    for (std::size_t vertex = 0; vertex + 1 < patch_vertices.first.size(); ++vertex)
      for (std::uint32_t a = patch_vertices.first[vertex]; a < patch_vertices.first[vertex + 1]; ++a)
        for (std::uint32_t b = a + 1; b < patch_vertices.first[vertex + 1]; ++b) add(seams, {a, b}, kSeamWeight);
  }

  void add(std::vector<Link>& links, Link link, double weight) {
    links.push_back(link);
    diagonal[link.a] += weight;
    diagonal[link.b] += weight;
  }

  /// The system's matrix times x.
  void apply(const Shifts& x, Shifts& product) const {
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int channel = 0; channel < 3; ++channel) product[i][channel] = diagonal[i] * x[i][channel];
    for (const auto& [links, weight] : {std::pair(&edges, kEdgeWeight), std::pair(&seams, kSeamWeight)})
      for (const Link& link : *links)
        for (int channel = 0; channel < 3; ++channel) {
          product[link.a][channel] -= weight * x[link.b][channel];
          product[link.b][channel] -= weight * x[link.a][channel];
        }
  }
};

double scalar_product(const Shifts& a, const Shifts& b) {
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) sums[channel] += a[i][channel] * b[i][channel];
  return sums[0] + sums[1] + sums[2];
}

/// a + factor * b, into target, which may be a.
void add_scaled(const Shifts& a, double factor, const Shifts& b, Shifts& target) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) target[i][channel] = a[i][channel] + factor * b[i][channel];
}

/// Conjugate gradients (Hestenes, Stiefel 1952), preconditioned by the diagonal, from 0.
Shifts solve(const LevelSystem& system, Shifts residual) {
  constexpr int kMostSteps = 200;
  constexpr double kSmall = 1e-8;  // of the residual's square
  Shifts x(residual.size());
  Shifts scaled(residual.size());
  Shifts product(residual.size());
  const auto precondition = [&] {
    for (std::size_t i = 0; i < residual.size(); ++i)
      for (int channel = 0; channel < 3; ++channel) scaled[i][channel] = residual[i][channel] / system.diagonal[i];
    return scalar_product(residual, scaled);
  };
  double size = precondition();
  const double enough = size * kSmall;
  Shifts direction = scaled;
  for (int step = 0; step < kMostSteps && size > enough; ++step) {
    system.apply(direction, product);
    const double length = size / scalar_product(direction, product);
    add_scaled(x, length, direction, x);
    add_scaled(residual, -length, product, residual);
    const double before = std::exchange(size, precondition());
    add_scaled(scaled, size / before, direction, direction);
  }
  return x;
}

}  // namespace

std::vector<LevelShift> level_seams(const Mesh& mesh, const std::vector<std::int32_t>& views,
                                    const PatchVertices& patch_vertices, const std::vector<LevelShift>& colors,
                                    const std::vector<LevelShift>& to_mean) {
  const LevelSystem system(mesh, views, patch_vertices);
  Shifts wanted(to_mean.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) wanted[i][channel] = kMeanWeight * double{to_mean[i][channel]};
  for (const Link& seam : system.seams)
    for (int channel = 0; channel < 3; ++channel) {
      const double rise = double{colors[seam.b][channel]} - double{colors[seam.a][channel]};
      wanted[seam.a][channel] += kSeamWeight * rise;
      wanted[seam.b][channel] -= kSeamWeight * rise;
    }
  const Shifts solved = solve(system, std::move(wanted));
  std::vector<LevelShift> shifts(solved.size());
  for (std::size_t i = 0; i < shifts.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) shifts[i][channel] = static_cast<float>(solved[i][channel]);
  return shifts;
}

}  // namespace quorum
