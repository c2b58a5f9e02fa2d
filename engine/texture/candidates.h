// The photographs that a triangle may be taken from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace quorum {

/// A photograph that shows a triangle.
struct Candidate {
  float quality = 0;  ///< projected area in pixels × sharpness; 0 = none
  std::uint32_t view = 0;
  std::array<std::uint8_t, 3> color = {};  ///< mean over the triangle
  bool disagrees = false;                  ///< with the others about the color
};

/// The best photographs of each triangle, best first; equally good ones by their order.
class Candidates {
 public:
  static constexpr int kMost = 8;  ///< of a triangle

  explicit Candidates(std::size_t triangles) : all_(triangles * kMost) {}

  /// Those of a triangle that are there.
  [[nodiscard]] std::span<Candidate> of(std::size_t triangle);
  [[nodiscard]] std::span<const Candidate> of(std::size_t triangle) const;
  /// That of a view, if it is there and does not disagree; else null.
  [[nodiscard]] const Candidate* find(std::size_t triangle, std::uint32_t view) const;
  void add(std::size_t triangle, const Candidate& candidate);
  [[nodiscard]] std::size_t triangles() const { return all_.size() / kMost; }

 private:
  std::vector<Candidate> all_;
};

/// Marks candidates that disagree about a triangle's color: with four or more, those that are off the median by more
/// than 24 levels and four times the median distance in some channel. Departs from the source's mean shift (its
/// section 3.3): a median needs no iterations and no start.
void mark_disagreement(Candidates& candidates);

}  // namespace quorum
