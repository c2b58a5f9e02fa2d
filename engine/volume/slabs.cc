#include "engine/volume/slabs.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "engine/core/check.h"

namespace quorum {

Slab make_slab(const std::vector<std::uint32_t>& blocks, std::size_t first, std::size_t end, const VoxelGrid& grid,
               std::size_t max_blocks) {
  QUORUM_CHECK_GE(max_blocks, kLeastSlabBlocks);
  std::set<std::uint32_t> beside;  // stored neighbors of the core that lie behind its last block
  std::size_t last = first;
  for (; last < end; ++last) {
    const std::uint32_t block = blocks[last];
    const auto position = grid.block_position(block);
    std::vector<std::uint32_t> added;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto next = position;
      if (++next[axis] == grid.blocks[axis]) continue;
      const std::uint32_t neighbor = grid.block_index(next[0], next[1], next[2]);
      if (std::binary_search(blocks.begin(), blocks.end(), neighbor) && !beside.contains(neighbor))
        added.push_back(neighbor);
    }
    const std::size_t count = last + 1 - first + beside.size() - beside.count(block) + added.size();
    if (count > max_blocks) break;
    beside.erase(block);
    beside.insert(added.begin(), added.end());
  }
  Slab slab;
  slab.core_count = last - first;
  slab.blocks.assign(blocks.begin() + static_cast<std::ptrdiff_t>(first),
                     blocks.begin() + static_cast<std::ptrdiff_t>(last));
  std::ranges::copy(beside, std::back_inserter(slab.blocks));
  return slab;
}

}  // namespace quorum
