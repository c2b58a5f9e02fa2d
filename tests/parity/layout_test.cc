#include "shaders/layout.h"

#include "tests/parity/parity_test.h"

namespace quorum {
namespace {

using Words = std::vector<std::uint32_t>;

/// A struct of which every word is a number of its own, positive as int and normal as float.
template <typename T>
T numbered(std::uint32_t start = 0) {
  std::array<std::uint32_t, sizeof(T) / 4> words;
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = 0x3f800000U + 0x1001U * (start + static_cast<std::uint32_t>(i));
  return std::bit_cast<T>(words);
}

template <typename T>
void append(Words& words, const T& member) {
  const auto bits = std::bit_cast<std::array<std::uint32_t, sizeof(T) / 4>>(member);
  words.insert(words.end(), bits.begin(), bits.end());
}

/// The members as C++ reads them.
template <typename... Members>
Words words_of(const Members&... members) {
  Words words;
  (append(words, members), ...);
  return words;
}

class LayoutParity : public ParityTest {
 protected:
  template <typename Params>
  static void compare(std::string_view probe, const Params& params, const Words& members) {
    ASSERT_EQ(members.size() * 4, sizeof(Params)) << probe << ": a member is missing in the test";
    const Buffer words = buffer_of(Words(members.size()));
    run(test_kernel(probe), {}, params, {words});
    same_words(content<std::uint32_t>(words), members, 1, std::string(probe));
  }
};

TEST_F(LayoutParity, SweepParamsAreReadMemberByMember) {
  const auto p = numbered<SweepParams>();
  compare("probe_sweep_params", p,
          words_of(p.warp.rotation, p.warp.offset, p.width, p.height, p.neighbor_width, p.neighbor_height,
                   p.reference_stride, p.window_stride, p.item_count, p.ncc_offset));
}

TEST_F(LayoutParity, VoteParamsAreReadMemberByMember) {
  const auto p = numbered<VoteParams>();
  compare("probe_vote_params", p,
          words_of(p.width, p.height, p.block_width, p.block_height, p.block_count, p.item_count, p.neighbor_count,
                   p.min_votes, p.threshold, p.confidence_scale));
}

TEST_F(LayoutParity, ReferenceWindowsParamsAreReadMemberByMember) {
  const auto p = numbered<ReferenceWindowsParams>();
  compare("probe_reference_windows_params", p, words_of(p.width, p.height, p.columns, p.rows));
}

TEST_F(LayoutParity, SupportWindowsParamsAreReadMemberByMember) {
  const auto p = numbered<SupportWindowsParams>();
  compare("probe_support_windows_params", p, words_of(p.width, p.height, p.tolerance));
}

TEST_F(LayoutParity, FirstPlanesParamsAreReadMemberByMember) {
  const auto p = numbered<FirstPlanesParams>();
  compare("probe_first_planes_params", p,
          words_of(p.width, p.height, p.outside_width, p.outside_height, p.outside_halvings, p.limit));
}

TEST_F(LayoutParity, RefinePlanesParamsAreReadMemberByMember) {
  const auto p = numbered<RefinePlanesParams>();
  compare("probe_refine_planes_params", p,
          words_of(p.width, p.height, p.row_begin, p.row_end, p.move_begin, p.move_end, p.neighbor_count, p.is_first,
                   p.min_votes, p.max_tilt, p.threshold, p.confidence_scale));
}

TEST_F(LayoutParity, ConfirmDepthsParamsAreReadMemberByMember) {
  const auto p = numbered<ConfirmDepthsParams>();
  compare("probe_confirm_depths_params", p,
          words_of(p.warp.rotation, p.warp.offset, p.back.rotation, p.back.offset, p.width, p.height, p.other_width,
                   p.other_height, p.other_max_step, p.footprint, p.other_footprint, p.steps));
}

TEST_F(LayoutParity, CollectParamsAreReadMemberByMember) {
  const auto p = numbered<CollectParams>();
  compare("probe_collect_params", p,
          words_of(p.ray_from_pixel, p.origin, p.blocks, p.width, p.height, p.depth_step, p.steps, p.margin));
}

TEST_F(LayoutParity, IntegrateParamsAreReadMemberByMember) {
  const auto p = numbered<IntegrateParams>();
  compare("probe_integrate_params", p,
          words_of(p.projection, p.inverse_focal_x, p.inverse_focal_y, p.principal_x, p.principal_y,
                   p.inverse_truncation, p.width, p.height, p.list_begin, p.blocks, p.pool_begin));
}

TEST_F(LayoutParity, StructsAreReadFromArrays) {
  std::vector<PlaneRange> ranges;
  std::vector<PixelVote> votes;
  std::vector<SweepItem> items;
  std::vector<SweepBlock> blocks;
  std::vector<ReferenceWindow> windows;
  std::vector<SupportWindow> supports;
  Words members;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto range = ranges.emplace_back(numbered<PlaneRange>(23 * i));
    const auto vote = votes.emplace_back(numbered<PixelVote>(23 * i + 2));
    const auto item = items.emplace_back(numbered<SweepItem>(23 * i + 5));
    const auto block = blocks.emplace_back(numbered<SweepBlock>(23 * i + 9));
    const auto window = windows.emplace_back(numbered<ReferenceWindow>(23 * i + 13));
    const auto support = supports.emplace_back(numbered<SupportWindow>(23 * i + 17));
    const Words words = words_of(range.first, range.last, vote.correlation, vote.confidence, vote.plane, item.x, item.y,
                                 item.plane, item.inverse_depth, block.x, block.y, block.item_begin, block.item_count,
                                 window.sum, window.inverse_deviation, support.sum, support.inverse_deviation,
                                 support.samples, support.max_difference);
    members.insert(members.end(), words.begin(), words.end());
  }
  const Buffer words = buffer_of(Words(members.size()));
  Commands commands = make_commands();
  const Kernel probe = test_kernel("probe_storage");
  const Buffer range_buffer = buffer_of(ranges);
  const Buffer vote_buffer = buffer_of(votes);
  const Buffer item_buffer = buffer_of(items);
  const Buffer block_buffer = buffer_of(blocks);
  const Buffer window_buffer = buffer_of(windows);
  const Buffer support_buffer = buffer_of(supports);
  commands.dispatch(probe, {},
                    {range_buffer, vote_buffer, item_buffer, block_buffer, window_buffer, support_buffer, words});
  submit(commands);
  same_words(content<std::uint32_t>(words), members, 1, "probe_storage");
}

}  // namespace
}  // namespace quorum
