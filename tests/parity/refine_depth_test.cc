#include "engine/depth/refine_depth.h"

#include "tests/parity/parity_test.h"
#include "tests/parity/window_input.h"

namespace quorum {
namespace {

constexpr float kUntested = -7.0F;

class RefineDepthParity : public ParityTest {
 protected:
  static void compare(const WindowCase& input, int row_begin, int row_count, int first_slot, int slots) {
    const SweepTask task = input.task();
    const auto ranges = refine_ranges(sweep_planes(task, task.ranges, task.planes.refinement, {}), task.planes);
    const int width = input.width;
    const int values = slots * row_count * width;
    const Kernel refine = kernel("refine_depth", input.constants());
    const Buffer reference = buffer_of(task.reference->pixels);
    const Buffer planes = buffer_of(task.planes.inverse_depth);
    const Buffer range_buffer = buffer_of(ranges.values);
    const auto total = static_cast<std::size_t>(values * task.neighbor_count());
    const Buffer ncc = buffer_of(std::vector<float>(total, kUntested));
    std::vector<float> twin(total, kUntested);
    int tested_count = 0;
    int matching_count = 0;
    for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
      SweepParams params = window_params(task, neighbor);
      params.row_begin = row_begin;
      params.row_count = row_count;
      params.first_plane = first_slot;
      params.plane_stride = 1;
      params.plane_count = slots;
      params.ncc_offset = neighbor * values;
      const Buffer image = buffer_of(task.neighbors[static_cast<std::size_t>(neighbor)]->pixels);
      run(refine, {width, row_count, slots}, params, {reference, image, planes, range_buffer, ncc});
      for (int slot = 0; slot < slots; ++slot) {
        for (int row = 0; row < row_count; ++row) {
          for (int x = 0; x < width; ++x) {
            const PlaneRange& range = ranges.at(x, row_begin + row);
            const std::uint32_t plane = range.first + static_cast<std::uint32_t>(first_slot + slot);
            if (range.first > range.last || plane > range.last) continue;
            const float value = window_ncc(task, neighbor, x, row_begin + row, static_cast<int>(plane));
            twin[static_cast<std::size_t>(neighbor * values + (slot * row_count + row) * width + x)] = value;
            ++tested_count;
            matching_count += value > 0.6F ? 1 : 0;
          }
        }
      }
    }
    ASSERT_TRUE(same_words(content<float>(ncc), twin, width, input.name()));
    expect_share(tested_count, values * task.neighbor_count(), 0.02, 0.95, "pixels that test planes");
    expect_share(matching_count, tested_count, 0.1, 0.999, "windows that match");
  }
};

TEST_F(RefineDepthParity, EveryWindowAndModelGivesTheBytesOfTheTwin) {
  for (const WindowCase& input : window_cases()) {
    if (input.model == WindowModel::kAxis && input.flip) continue;  // finds almost nothing to refine
    compare(input, 0, input.height, 0, 20);
    if (HasFailure()) return;
  }
}

TEST_F(RefineDepthParity, BatchesOfRowsAndSlotsDoNotMatter) {
  const WindowCase input{5, WindowModel::kPlane, true, 67, 45, 21};
  compare(input, 11, 23, 0, 7);
  compare(input, 11, 23, 7, 12);
}

}  // namespace
}  // namespace quorum
