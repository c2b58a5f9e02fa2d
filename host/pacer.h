// When to submit what is recorded: after as much work as keeps a submission near a tenth of a second.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "host/batch_size.h"
#include "host/commands.h"

namespace quorum {

class Pacer {
 public:
  Pacer(Commands& commands, BatchSize& size) : commands_(&commands), size_(&size) {}

  /// Work items that still fit the submission; at least 1.
  [[nodiscard]] std::int64_t room() const { return std::max<std::int64_t>(1, size_->items() - recorded_); }

  /// Submits what is recorded if it leaves too little room for so many items.
  Expected<void> make_room(std::int64_t items) { return recorded_ > 0 && room() < items ? submit() : Expected<void>(); }

  /// Work was recorded; submits if it is enough. Fails as Commands::submit does.
  Expected<void> recorded(std::int64_t items) {
    recorded_ += items;
    return recorded_ < size_->items() ? Expected<void>() : submit();
  }

  /// Submits the rest.
  Expected<void> submit() {
    QUORUM_TRY(commands_->submit());
    submitted();
    return {};
  }

  /// The rest was submitted, as by a download.
  void submitted() { size_->measured(std::exchange(recorded_, 0), commands_->last_submission_seconds()); }

 private:
  Commands* commands_;
  BatchSize* size_;
  std::int64_t recorded_ = 0;  ///< items, not submitted yet
};

}  // namespace quorum
