#include "host/sweep_batch.h"

#include <algorithm>

namespace quorum {

SweepBatches::SweepBatches(const Grid<PlaneRange>& ranges, std::span<const float> inverse_depths, BlockSize block,
                           int stride)
    : ranges_(&ranges), inverse_depths_(inverse_depths), block_(block), stride_(stride) {
  if (!ranges.empty()) collect_planes();
}

SweepBatch SweepBatches::next(std::int64_t most_items, std::int64_t most_planes) {
  SweepBatch batch;
  while (y_ < ranges_->height) {
    if (planes_done_ < planes_.size()) {
      const auto room = static_cast<std::size_t>(most_items) - batch.items.size();
      if (room == 0) return batch;
      const std::size_t count = std::min({planes_.size() - planes_done_, room, static_cast<std::size_t>(most_planes)});
      batch.blocks.push_back({x_, y_, static_cast<int>(batch.items.size()), static_cast<int>(count)});
      for (std::size_t i = planes_done_; i < planes_done_ + count; ++i)
        batch.items.push_back({x_, y_, planes_[i], inverse_depths_[static_cast<std::size_t>(planes_[i])]});
      planes_done_ += count;
      if (planes_done_ < planes_.size()) return batch;  // a block comes once in a batch
    }
    x_ += block_.width;
    if (x_ >= ranges_->width) {
      x_ = 0;
      y_ += block_.height;
    }
    if (y_ < ranges_->height) collect_planes();
  }
  return batch;
}

void SweepBatches::collect_planes() {
  planes_.clear();
  planes_done_ = 0;
  const int x_end = std::min(x_ + block_.width, ranges_->width);
  const int y_end = std::min(y_ + block_.height, ranges_->height);
  uint first = ~0U;
  uint last = 0;
  for (int y = y_; y < y_end; ++y) {
    const PlaneRange* row = ranges_->row(y);
    for (int x = x_; x < x_end; ++x) {
      if (row[x].first > row[x].last) continue;
      first = std::min(first, row[x].first);
      last = std::max(last, row[x].last);
    }
  }
  if (first > last) return;
  // How many more pixels test a plane than the one before it.
  const auto step = static_cast<uint>(stride_);
  changes_.assign((last - first) / step + 2, 0);
  for (int y = y_; y < y_end; ++y) {
    const PlaneRange* row = ranges_->row(y);
    for (int x = x_; x < x_end; ++x) {
      if (row[x].first > row[x].last) continue;
      ++changes_[(row[x].first - first + step - 1) / step];
      --changes_[(row[x].last - first) / step + 1];
    }
  }
  int testing = 0;
  for (std::size_t i = 0; i + 1 < changes_.size(); ++i) {
    testing += changes_[i];
    if (testing > 0) planes_.push_back(static_cast<int>(first + static_cast<uint>(i) * step));
  }
}

}  // namespace quorum
