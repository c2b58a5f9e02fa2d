// The comparison of the kernels that vote, vote_depth and vote_depth_lanes, with their common twin on seeded votes.
#pragma once

#include <random>

#include "engine/depth/vote_depth.h"
#include "host/sweep_batch.h"
#include "tests/parity/parity_test.h"

namespace quorum {

struct VoteCase {
  int width;
  int height;
  int neighbors;
  int min_votes;
  float threshold;
  int stride;
  BlockSize block;
  int most_items;  // of a batch
  unsigned seed;
};

/// One kernel that votes beside vote(), over the batches of a case.
class VoteParity : public ParityTest {
 protected:
  static void compare_all(std::string_view kernel_name) {
    compare({131, 37, 4, 2, 0.6F, 10, {8, 8}, 400, 1}, kernel_name);
    compare({67, 45, 3, 2, 0.6F, 1, {16, 16}, 150, 2}, kernel_name);
    compare({63, 20, 9, 1, 0.9F, 1, {4, 4}, 1 << 20, 3}, kernel_name);
    compare({97, 21, 32, 7, 0.5F, 3, {16, 16}, 60, 4}, kernel_name);
    compare({65, 33, 2, 2, 0.0F, 1, {8, 2}, 700, 5}, kernel_name);
  }

 private:
  static void compare(const VoteCase& input, std::string_view kernel_name) {
    const auto pixels = static_cast<std::int64_t>(input.width) * input.height;
    std::mt19937 random(input.seed);
    const auto uniform = [&](float low, float high) {
      return std::uniform_real_distribution<float>(low, high)(random);
    };
    Grid<PlaneRange> ranges(input.width, input.height);
    for (PlaneRange& range : ranges.values) {
      range.first = static_cast<std::uint32_t>(random() % 10);
      range.last = range.first + static_cast<std::uint32_t>(random() % 60);
      if (random() % 5 == 0) range = {1, 0};
    }
    SweepOptions options;
    options.threshold = input.threshold;
    options.min_votes = input.min_votes;
    const VoteRule rule = make_vote_rule(options, input.neighbors);
    const Kernel vote_depth = kernel(kernel_name);
    const Buffer range_buffer = buffer_of(ranges.values);
    Grid<PixelVote> twin(input.width, input.height, kNoVote);
    const Buffer votes = buffer_of(twin.values);
    const std::vector<float> inverse_depths(100, 1.0F);
    const int block_pixels = input.block.pixels();
    SweepBatches batches(ranges, inverse_depths, input.block, input.stride);
    for (SweepBatch batch = batches.next(input.most_items, 6); !batch.items.empty();
         batch = batches.next(input.most_items, 6)) {
      std::vector<float> ncc(static_cast<std::size_t>(input.neighbors * block_pixels) * batch.items.size());
      for (float& value : ncc) {
        const unsigned kind = static_cast<unsigned>(random() % 10);
        value = kind == 0 ? -1.0F : kind == 1 ? input.threshold : kind == 2 ? 0.875F : uniform(-1.0F, 1.0F);
      }
      const VoteParams params{.width = input.width,
                              .height = input.height,
                              .block_width = input.block.width,
                              .block_height = input.block.height,
                              .block_count = static_cast<int>(batch.blocks.size()),
                              .item_count = static_cast<int>(batch.items.size()),
                              .neighbor_count = input.neighbors,
                              .min_votes = rule.min_votes,
                              .threshold = rule.threshold,
                              .confidence_scale = rule.confidence_scale};
      run(vote_depth, {params.block_count * block_pixels / 4}, params,
          {buffer_of(batch.blocks), buffer_of(batch.items), range_buffer, buffer_of(ncc), votes});
      for (std::size_t item = 0; item < batch.items.size(); ++item) {
        for (int pixel = 0; pixel < block_pixels; ++pixel) {
          const int x = batch.items[item].x + pixel % input.block.width;
          const int y = batch.items[item].y + pixel / input.block.width;
          if (!ranges.contains(x, y)) continue;
          const auto plane = static_cast<std::uint32_t>(batch.items[item].plane);
          if (plane < ranges.at(x, y).first || plane > ranges.at(x, y).last) continue;
          float sum = 0.0F;
          int count = 0;
          for (int neighbor = 0; neighbor < input.neighbors; ++neighbor) {
            const std::size_t block = static_cast<std::size_t>(neighbor) * batch.items.size() + item;
            const float value = ncc[block * static_cast<std::size_t>(block_pixels) + static_cast<std::size_t>(pixel)];
            if (value > rule.threshold) sum += value, ++count;
          }
          twin.at(x, y) = vote(twin.at(x, y), sum, count, batch.items[item].plane, rule);
        }
      }
      ASSERT_TRUE(same_words(content<PixelVote>(votes), twin.values, input.width,
                             fmt::format("{} seed {}", kernel_name, input.seed)));
    }
    const auto found = std::ranges::count_if(twin.values, [](const PixelVote& value) { return value.plane >= 0; });
    expect_share(found, pixels, 0.1, 0.95, "pixels with a plane");
  }
};

}  // namespace quorum
