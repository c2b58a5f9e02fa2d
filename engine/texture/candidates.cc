#include "engine/texture/candidates.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>

namespace quorum {
namespace {

/// The lower one of two.
int median(std::array<int, Candidates::kMost> values, std::size_t count) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((count - 1) / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

void mark_disagreement_of(std::span<Candidate> candidates) {
  constexpr std::size_t kFewest = 4;
  constexpr int kFewLevels = 24;
  constexpr int kDistances = 4;
  const std::size_t count = candidates.size();
  if (count < kFewest) return;
  std::array<int, Candidates::kMost> distances{};
  for (int channel = 0; channel < 3; ++channel) {
    std::array<int, Candidates::kMost> levels{};
    for (std::size_t i = 0; i < count; ++i) levels[i] = candidates[i].color[channel];
    const int middle = median(levels, count);
    for (std::size_t i = 0; i < count; ++i) distances[i] = std::max(distances[i], std::abs(levels[i] - middle));
  }
  const int most = std::max(kFewLevels, kDistances * median(distances, count));
  for (std::size_t i = 0; i < count; ++i) candidates[i].disagrees = distances[i] > most;
}

}  // namespace

std::span<Candidate> Candidates::of(std::size_t triangle) {
  Candidate* first = all_.data() + triangle * kMost;
  std::size_t count = 0;
  while (count < kMost && first[count].quality > 0) ++count;
  return {first, count};
}

std::span<const Candidate> Candidates::of(std::size_t triangle) const {
  return const_cast<Candidates*>(this)->of(triangle);
}

const Candidate* Candidates::find(std::size_t triangle, std::uint32_t view) const {
  for (const Candidate& candidate : of(triangle))
    if (candidate.view == view) return candidate.disagrees ? nullptr : &candidate;
  return nullptr;
}

void Candidates::add(std::size_t triangle, const Candidate& candidate) {
  Candidate* first = all_.data() + triangle * kMost;
  int place = kMost;
  while (place > 0 && first[place - 1].quality < candidate.quality) --place;
  if (place == kMost) return;
  std::move_backward(first + place, first + kMost - 1, first + kMost);
  first[place] = candidate;
}

void mark_disagreement(Candidates& candidates) {
  tbb::parallel_for(std::size_t{0}, candidates.triangles(),
                    [&](std::size_t t) { mark_disagreement_of(candidates.of(t)); });
}

}  // namespace quorum
