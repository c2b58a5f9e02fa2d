// Views of a ConfirmTask, which shares them.
#pragma once

#include <memory>
#include <utility>

#include "engine/volume/confirm_depths.h"

namespace quorum {

inline std::shared_ptr<const ViewDepths> shared(ViewDepths view) {
  return std::make_shared<const ViewDepths>(std::move(view));
}

/// A view of a task, to be changed: a copy takes its place.
inline ViewDepths& changed(std::shared_ptr<const ViewDepths>& view) {
  auto copy = std::make_shared<ViewDepths>(*view);
  ViewDepths& result = *copy;
  view = std::move(copy);
  return result;
}

}  // namespace quorum
