// The photograph that each triangle is taken from: one that shows it well, in patches that are large (Waechter,
// Moehrle, Goesele 2014, section 3.1).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/texture/candidates.h"
#include "engine/texture/mesh_links.h"

namespace quorum {

constexpr std::int32_t kUnseen = -1;

/// Pixels that a triangle covers in a view that the surface around it faces, whatever hides it there; below 0 if it
/// does not face it, or lies not whole in the frame.
using FacingPixels = std::function<double(std::uint32_t triangle, std::int32_t view)>;

/// Per triangle the index of a view, or kUnseen without candidates. Departs from the source, whose graph cuts take
/// floats and depend on their order. Qualities, as shares of the best one of a triangle, spread to its neighbors step
/// by step. Views with a share of 60 % or more count as equally good, and the one that is good enough for most
/// triangles takes these, again and again (greedy set cover, Chvatal 1979). Then each triangle in turn weighs that
/// against what its neighbors have (iterated conditional modes, Besag 1986), and patches of few triangles take the view
/// of a patch beside them, where it shows all of them with 40 % of the best quality on average, or they are less than
/// 16 pixels in all. All decisions are between integers.
std::vector<std::int32_t> choose_views(const MeshLinks& links, const Candidates& candidates,
                                       const FacingPixels& facing);

}  // namespace quorum
