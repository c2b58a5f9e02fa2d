#include "engine/depth/sweep_depth.h"

#include "tests/parity/parity_test.h"
#include "tests/parity/window_input.h"

namespace quorum {
namespace {

constexpr float kUntested = -7.0F;

class SweepDepthParity : public ParityTest {
 protected:
  /// Compares one batch of rows and slots of one case for all neighbors.
  static void compare(const WindowCase& input, int row_begin, int row_count, std::uint32_t strip_rows) {
    const SweepTask task = input.task();
    const int stride = task.planes.refinement;
    const int first_slot = 1;
    const int slots = (static_cast<int>(task.planes.depth.size()) - 1) / stride;
    const int width = input.width;
    const int values = slots * row_count * width;
    auto constants = input.constants();
    constants.push_back({"kStripRows", strip_rows});
    const Kernel sweep = kernel("sweep_depth", constants);
    const Buffer reference = buffer_of(task.reference->pixels);
    const Buffer planes = buffer_of(task.planes.inverse_depth);
    const Buffer ranges = buffer_of(task.ranges.values);
    const auto total = static_cast<std::size_t>(values * task.neighbor_count());
    const Buffer ncc = buffer_of(std::vector<float>(total, kUntested));
    std::vector<float> twin(total, kUntested);
    std::vector<bool> tested(total, false);
    int tested_count = 0;
    int seen_count = 0;
    int matching_count = 0;
    for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
      SweepParams params = window_params(task, neighbor);
      params.row_begin = row_begin;
      params.row_count = row_count;
      params.first_plane = first_slot * stride;
      params.plane_stride = stride;
      params.plane_count = slots;
      params.ncc_offset = neighbor * values;
      const Buffer image = buffer_of(task.neighbors[static_cast<std::size_t>(neighbor)]->pixels);
      run(sweep, {width, (row_count + static_cast<int>(strip_rows) - 1) / static_cast<int>(strip_rows), slots}, params,
          {reference, image, planes, ranges, ncc});
      for (int slot = 0; slot < slots; ++slot) {
        for (int row = 0; row < row_count; ++row) {
          for (int x = 0; x < width; ++x) {
            const auto plane = static_cast<std::uint32_t>((first_slot + slot) * stride);
            const PlaneRange& range = task.ranges.at(x, row_begin + row);
            if (plane < range.first || plane > range.last) continue;
            const auto index = static_cast<std::size_t>(neighbor * values + (slot * row_count + row) * width + x);
            const float value = window_ncc(task, neighbor, x, row_begin + row, static_cast<int>(plane));
            tested[index] = true;
            twin[index] = value;
            ++tested_count;
            seen_count += value > kNoNcc ? 1 : 0;
            matching_count += value > 0.6F ? 1 : 0;
          }
        }
      }
    }
    auto on_device = content<float>(ncc);
    for (std::size_t index = 0; index < total; ++index)
      if (!tested[index]) on_device[index] = kUntested;  // a strip may fill gaps between pixels that test the plane
    ASSERT_TRUE(same_words(on_device, twin, width, input.name()));
    expect_share(tested_count, values * task.neighbor_count(), 0.05, 0.9, "pixels that test planes");
    expect_share(seen_count, tested_count, 0.1, 1.0, "windows that neighbors see");
    expect_share(matching_count, tested_count, 0.005, 0.9, "windows that match");
  }
};

TEST_F(SweepDepthParity, EveryWindowAndModelGivesTheBytesOfTheTwin) {
  for (const WindowCase& input : window_cases()) {
    compare(input, 0, input.height, 16);
    if (HasFailure()) return;
  }
}

TEST_F(SweepDepthParity, BatchesOfRowsAndLengthsOfStripsDoNotMatter) {
  const WindowCase input{5, WindowModel::kPlane, true, 67, 45, 21};
  compare(input, 7, 23, 16);
  compare(input, 19, 1, 16);
  compare(input, 3, 37, 5);
  compare(input, 3, 37, 1);
}

}  // namespace
}  // namespace quorum
