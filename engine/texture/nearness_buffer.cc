#include "engine/texture/nearness_buffer.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace quorum {
namespace {

/// The largest counts, so the order of threads does not.
void raise(std::uint32_t& value, std::uint32_t to) {
  const std::atomic_ref<std::uint32_t> shared(value);
  std::uint32_t known = shared.load(std::memory_order_relaxed);
  while (known < to && !shared.compare_exchange_weak(known, to, std::memory_order_relaxed)) {
  }
}

/// Of all within `reach` of each pixel the one that `better` prefers.
template <typename Better>
Grid<std::uint32_t> best_around(const Grid<std::uint32_t>& values, int reach, const Better& better) {
  Grid<std::uint32_t> along_x(values.width, values.height);
  Grid<std::uint32_t> around(values.width, values.height);
  const auto best = [&](int at, int end, const auto& value) {
    std::uint32_t found = value(at);
    for (int i = std::max(at - reach, 0); i <= std::min(at + reach, end - 1); ++i) found = better(found, value(i));
    return found;
  };
  tbb::parallel_for(0, values.height, [&](int y) {
    for (int x = 0; x < values.width; ++x)
      along_x.at(x, y) = best(x, values.width, [&](int at) { return values.at(at, y); });
  });
  tbb::parallel_for(0, values.height, [&](int y) {
    for (int x = 0; x < values.width; ++x)
      around.at(x, y) = best(y, values.height, [&](int at) { return along_x.at(x, at); });
  });
  return around;
}

}  // namespace

NearnessBuffer nearness_buffer(const Mesh& mesh, const ProjectedMesh& projected, int width, int height) {
  Grid<std::uint32_t> buffer(width, height);
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
    const ProjectedVertex& a = projected.vertices[mesh.triangles[t][0]];
    const ProjectedVertex& b = projected.vertices[mesh.triangles[t][1]];
    const ProjectedVertex& c = projected.vertices[mesh.triangles[t][2]];
    if (a.nearness == 0 || b.nearness == 0 || c.nearness == 0) return;
    TrianglePixels(a, b, c).for_each(width, height, [&](int x, int y, const std::array<double, 3>& shares) {
      raise(buffer.at(x, y),
            static_cast<std::uint32_t>(shares[0] * a.nearness + shares[1] * b.nearness + shares[2] * c.nearness));
    });
  });
  constexpr int kOutline = 3;
  return {best_around(buffer, 1, [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); }),
          best_around(buffer, kOutline, [](std::uint32_t a, std::uint32_t b) { return std::min(a, b); })};
}

}  // namespace quorum
