#include "engine/depth/vote_depth.h"

#include <random>

#include "tests/parity/parity_test.h"

namespace quorum {
namespace {

struct VoteCase {
  int width;
  int height;
  int neighbors;
  int min_votes;
  float threshold;
  int stride;
  bool relative;
  unsigned seed;
};

class VoteDepthParity : public ParityTest {
 protected:
  /// Two batches of slots, one after the other, over rows that do not start at the top.
  static void compare(const VoteCase& input) {
    constexpr int kSlots = 6;
    const int row_begin = 1;
    const int row_count = input.height - 1;
    const auto pixels = static_cast<std::size_t>(input.width * input.height);
    std::mt19937 random(input.seed);
    const auto uniform = [&](float low, float high) {
      return std::uniform_real_distribution<float>(low, high)(random);
    };
    std::vector<PlaneRange> ranges(pixels);
    for (PlaneRange& range : ranges) {
      range.first = static_cast<std::uint32_t>(random() % 10);
      range.last = range.first + static_cast<std::uint32_t>(random() % 60);
      if (random() % 5 == 0) range = {1, 0};
    }
    SweepOptions options;
    options.threshold = input.threshold;
    options.min_votes = input.min_votes;
    const VoteRule rule = make_vote_rule(options, input.neighbors);
    const Kernel vote_depth = kernel("vote_depth");
    const Buffer range_buffer = buffer_of(ranges);
    std::vector<PixelVote> twin(pixels, kNoVote);
    const Buffer votes = buffer_of(twin);
    for (int batch = 0; batch < 2; ++batch) {
      std::vector<float> ncc(static_cast<std::size_t>(input.neighbors * kSlots * row_count * input.width));
      for (float& value : ncc) {
        const unsigned kind = static_cast<unsigned>(random() % 10);
        value = kind == 0 ? -1.0F : kind == 1 ? input.threshold : kind == 2 ? 0.875F : uniform(-1.0F, 1.0F);
      }
      const VoteParams params{.width = input.width,
                              .row_begin = row_begin,
                              .row_count = row_count,
                              .first_plane = batch * kSlots * input.stride,
                              .plane_stride = input.stride,
                              .plane_count = kSlots,
                              .neighbor_count = input.neighbors,
                              .min_votes = rule.min_votes,
                              .threshold = rule.threshold,
                              .confidence_scale = rule.confidence_scale,
                              .relative_planes = input.relative ? 1 : 0};
      run(vote_depth, {input.width, row_count}, params, {range_buffer, buffer_of(ncc), votes});
      for (int row = 0; row < row_count; ++row) {
        for (int x = 0; x < input.width; ++x) {
          const auto pixel = static_cast<std::size_t>((row_begin + row) * input.width + x);
          const PlaneRange& range = ranges[pixel];
          for (int slot = 0; slot < kSlots && range.first <= range.last; ++slot) {
            const std::uint32_t plane = static_cast<std::uint32_t>(params.first_plane + slot * input.stride) +
                                        (input.relative ? range.first : 0U);
            if (plane < range.first || plane > range.last) continue;
            float sum = 0.0F;
            int count = 0;
            for (int neighbor = 0; neighbor < input.neighbors; ++neighbor) {
              const float value =
                  ncc[static_cast<std::size_t>(((neighbor * kSlots + slot) * row_count + row) * input.width + x)];
              if (value > rule.threshold) sum += value, ++count;
            }
            twin[pixel] = vote(twin[pixel], sum, count, static_cast<int>(plane), rule);
          }
        }
      }
      ASSERT_TRUE(
          same_words(content<PixelVote>(votes), twin, input.width, fmt::format("seed {} batch {}", input.seed, batch)));
    }
    const auto found = std::ranges::count_if(twin, [](const PixelVote& value) { return value.plane >= 0; });
    expect_share(found, static_cast<std::int64_t>(pixels), 0.1, 0.95, "pixels with a plane");
  }
};

TEST_F(VoteDepthParity, SeededVotesGiveTheBytesOfTheTwin) {
  compare({131, 37, 4, 2, 0.6F, 10, false, 1});
  compare({67, 45, 3, 2, 0.6F, 1, true, 2});
  compare({63, 20, 9, 1, 0.9F, 1, false, 3});
  compare({97, 21, 32, 7, 0.5F, 3, false, 4});
  compare({65, 33, 2, 2, 0.0F, 1, true, 5});
}

}  // namespace
}  // namespace quorum
