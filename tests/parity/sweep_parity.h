// The comparison of the kernels that sweep, sweep_depth and sweep_depth_lanes, with their common twin.
#pragma once

#include "engine/depth/ncc_from_sums.h"
#include "engine/depth/reference_windows.h"
#include "engine/depth/refine_depth.h"
#include "host/depth_stage.h"
#include "host/sweep_texels.h"
#include "tests/parity/parity_test.h"
#include "tests/parity/window_input.h"

namespace quorum {

enum class Pass { kFirst, kSecond };

/// One kernel of the sweep beside window_ncc, for each neighbor over the batches of a pass.
class SweepParity : public ParityTest {
 protected:
  static constexpr std::int64_t kAll = 1 << 30;

  /// Compares the batches of one pass of one case for all neighbors. most_items: of a batch.
  static void compare(const WindowCase& input, SweepForm form, BlockSize block, Pass pass, std::int64_t most_items) {
    const SweepTask task = input.task();
    const bool first = pass == Pass::kFirst;
    const int stride = first ? task.planes.refinement : 1;
    const auto ranges =
        first ? task.ranges : refine_ranges(sweep_planes(task, task.ranges, task.planes.refinement, {}), task.planes);
    const bool lanes = form == SweepForm::kLanes;
    const Kernel sweep = kernel(lanes ? "sweep_depth_lanes" : "sweep_depth", input.constants(form, block));
    const Buffer reference =
        lanes ? buffer_of(make_reference_texels(*task.reference, input.window)) : buffer_of(task.reference->pixels);
    const Buffer windows = buffer_of(in_whole_blocks(make_reference_windows(*task.reference, input.window)).values);
    std::vector<Buffer> neighbors;
    for (const auto& image : task.neighbors)
      neighbors.push_back(lanes ? buffer_of(make_quads(*image)) : buffer_of(image->pixels));
    SweepBatches batches(ranges, task.planes.inverse_depth, block, stride);
    for (SweepBatch batch = batches.next(most_items, kAll); !batch.items.empty();
         batch = batches.next(most_items, kAll)) {
      const Buffer items = buffer_of(batch.items);
      const auto item_count = static_cast<std::int64_t>(batch.items.size());
      const std::int64_t values = item_count * block.pixels();
      const Buffer ncc =
          buffer_of(std::vector<float>(static_cast<std::size_t>(values * task.neighbor_count()), kUntested));
      for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
        SweepParams params = window_params(task, neighbor);
        params.reference_stride = reference_texels_stride(input.width, input.window);
        params.window_stride = whole_blocks(input.width);
        params.item_count = static_cast<int>(item_count);
        params.ncc_offset = static_cast<int>(neighbor * values / 4);
        run(sweep, {lanes ? item_count : values}, params,
            {items, reference, windows, neighbors[static_cast<std::size_t>(neighbor)], ncc});
      }
      compare_values(task, input, ranges, batch, block, content<float>(ncc));
      if (HasFailure()) return;
    }
  }

 private:
  static constexpr float kUntested = -7.0F;

  /// Compares what pixels test; the other values of a block are free.
  static void compare_values(const SweepTask& task, const WindowCase& input, const Grid<PlaneRange>& ranges,
                             const SweepBatch& batch, BlockSize block, std::vector<float> on_device) {
    std::vector<float> twin(on_device.size(), kUntested);
    std::vector<bool> tested(on_device.size(), false);
    int tested_count = 0;
    int seen_count = 0;
    int matching_count = 0;
    std::size_t index = 0;
    for (int neighbor = 0; neighbor < task.neighbor_count(); ++neighbor) {
      for (const SweepItem& item : batch.items) {
        for (int pixel = 0; pixel < block.pixels(); ++pixel, ++index) {
          const int x = item.x + pixel % block.width;
          const int y = item.y + pixel / block.width;
          if (!ranges.contains(x, y)) continue;
          const PlaneRange& range = ranges.at(x, y);
          const auto plane = static_cast<std::uint32_t>(item.plane);
          if (plane < range.first || plane > range.last) continue;
          tested[index] = true;
          twin[index] = window_ncc(task, neighbor, x, y, item.plane);
          ++tested_count;
          seen_count += twin[index] > kNoNcc ? 1 : 0;
          matching_count += twin[index] > 0.6F ? 1 : 0;
        }
      }
    }
    for (std::size_t i = 0; i < tested.size(); ++i)
      if (!tested[i]) on_device[i] = kUntested;
    ASSERT_TRUE(same_words(on_device, twin, block.width, input.name()));
    expect_share(tested_count, static_cast<std::int64_t>(tested.size()), 0.05, 0.95, "pixels that test planes");
    expect_share(seen_count, tested_count, 0.1, 1.0, "windows that neighbors see");
    expect_share(matching_count, tested_count, 0.005, 0.999, "windows that match");
  }
};

}  // namespace quorum
