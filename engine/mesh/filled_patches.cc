#include "engine/mesh/filled_patches.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "engine/mesh/block_cubes.h"
#include "engine/mesh/disjoint_sets.h"

namespace quorum {
namespace {

constexpr int kSmoothingRounds = 50;

/// The triangles have a filled corner. Ring by ring: filled vertices without a color take the mean of those around that
/// have one since the last ring.
void color_filled(Mesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  struct Sum {
    std::uint32_t red = 0;
    std::uint32_t green = 0;
    std::uint32_t blue = 0;
    std::uint32_t count = 0;
  };
  std::vector<char> colored(mesh.vertices.size());
  for (std::size_t vertex = 0; vertex < colored.size(); ++vertex) colored[vertex] = !is_filled(mesh.vertices[vertex]);
  std::vector<std::array<std::uint32_t, 3>> left = triangles;
  std::vector<Sum> sums(mesh.vertices.size());
  while (true) {
    std::vector<std::uint32_t> ring;
    for (const auto& triangle : left) {
      for (const std::uint32_t to : triangle) {
        if (colored[to] != 0) continue;
        for (const std::uint32_t from : triangle) {
          if (colored[from] == 0) continue;
          if (sums[to].count == 0) ring.push_back(to);
          const Rgba color = mesh.vertices[from].color;
          sums[to] = {sums[to].red + red_of(color), sums[to].green + green_of(color), sums[to].blue + blue_of(color),
                      sums[to].count + 1};
        }
      }
    }
    if (ring.empty()) return;
    for (const std::uint32_t vertex : ring) {
      const Sum& sum = sums[vertex];
      const auto mean = [&](std::uint32_t channel) { return (channel + sum.count / 2) / sum.count; };
      mesh.vertices[vertex].color = make_rgb(mean(sum.red), mean(sum.green), mean(sum.blue));
      colored[vertex] = 1;
    }
    std::erase_if(left, [&](const std::array<std::uint32_t, 3>& triangle) {
      return std::ranges::all_of(triangle, [&](std::uint32_t corner) { return colored[corner] != 0; });
    });
  }
}

}  // namespace

void settle_filled(Mesh& mesh) {
  smooth_filled(mesh, kSmoothingRounds);
  add_normals(mesh);
}

void drop_unbounded(Mesh& mesh, const std::vector<char>& at_border, double largest_share) {
  DisjointSets patches(mesh.vertices.size());
  const auto filled = [&](std::uint32_t vertex) { return is_filled(mesh.vertices[vertex]); };
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}})
      if (filled(from) && filled(to)) patches.join(from, to);
  std::vector<char> measured(mesh.vertices.size());  // at representatives of patches
  std::vector<char> unbounded(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    const bool touches = !std::ranges::all_of(triangle, filled);
    for (const std::uint32_t corner : triangle) {
      if (!filled(corner)) continue;
      if (touches) measured[patches.find(corner)] = 1;
      if (at_border[corner] != 0) unbounded[patches.find(corner)] = 1;
    }
  }
  std::vector<std::uint32_t> size(mesh.vertices.size());  // at representatives of patches
  std::size_t measured_count = 0;
  for (std::uint32_t vertex = 0; vertex < size.size(); ++vertex) {
    if (filled(vertex))
      ++size[patches.find(vertex)];
    else
      ++measured_count;
  }
  const double largest = largest_share * static_cast<double>(measured_count);
  std::erase_if(mesh.triangles, [&](const std::array<std::uint32_t, 3>& triangle) {
    return std::ranges::any_of(triangle, [&](std::uint32_t corner) {
      if (!filled(corner)) return false;
      const std::uint32_t patch = patches.find(corner);
      return unbounded[patch] != 0 || measured[patch] == 0 || static_cast<double>(size[patch]) > largest;
    });
  });
}

void smooth_filled(Mesh& mesh, int rounds) {
  std::vector<std::array<std::uint32_t, 3>> around;  // triangles with a filled corner
  for (const auto& triangle : mesh.triangles)
    if (std::ranges::any_of(triangle, [&](std::uint32_t corner) { return is_filled(mesh.vertices[corner]); }))
      around.push_back(triangle);
  color_filled(mesh, around);

  std::vector<Eigen::Vector3d> positions(mesh.vertices.size());
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
    positions[vertex] = mesh.vertices[vertex].position.cast<double>();
  std::vector<Eigen::Vector3d> sums(positions.size());
  std::vector<int> counts(positions.size());
  for (int round = 0; round < rounds; ++round) {
    std::ranges::fill(sums, Eigen::Vector3d::Zero());
    std::ranges::fill(counts, 0);
    for (const auto& triangle : around) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        sums[triangle[corner]] += positions[triangle[(corner + 1) % 3]] + positions[triangle[(corner + 2) % 3]];
        counts[triangle[corner]] += 2;
      }
    }
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
      if (is_filled(mesh.vertices[vertex]) && counts[vertex] > 0) positions[vertex] = sums[vertex] / counts[vertex];
  }
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
    if (is_filled(mesh.vertices[vertex])) mesh.vertices[vertex].position = positions[vertex].cast<float>();
}

}  // namespace quorum
