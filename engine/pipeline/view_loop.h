// The one loop over views: while a view is worked on, the next ones are read and what the last ones gave is written.
#pragma once

#include <deque>
#include <future>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "engine/pipeline/background_thread.h"
#include "engine/pipeline/run.h"

namespace quorum {

/// The names under which the report has the times of a loop; null = not told.
struct ViewLoopStages {
  const char* read = nullptr;
  const char* work = nullptr;
  const char* write = nullptr;
};

/// Views that are read ahead, and views that are written behind, each on a thread of its own; at least one.
struct ViewsInFlight {
  std::size_t count = 1;
};

/// For each of the views, in order: read(view) -> Expected<Input> on a thread beside, work(view, input) ->
/// Expected<Output>, and write(view, output) -> Expected<void> on another thread beside; with more than one view in
/// flight, reads run at the same time, and so do writes. A step of the progress each, when its view is written. Ends
/// with the first failure, and before the next view if the run is to stop (kStopped); what is being written then is
/// written to its end.
template <typename Read, typename Work, typename Write>
Expected<void> for_each_view(Run& run, const std::vector<int>& views, const ViewLoopStages& stages, const Read& read,
                             const Work& work, const Write& write, ViewsInFlight in_flight = {}) {
  BackgroundThreads readers(in_flight.count);
  BackgroundThreads writers(in_flight.count);
  std::deque<std::future<std::invoke_result_t<const Read&, int>>> reading;
  std::deque<std::future<Expected<void>>> writing;
  const auto next_of = [](auto& queue) {
    auto result = std::move(queue.front());
    queue.pop_front();
    return result.get();
  };
  std::size_t begun = 0;
  const auto read_ahead = [&] {
    for (; begun < views.size() && reading.size() < in_flight.count; ++begun)
      reading.push_back(readers.run([&read, view = views[begun]] { return read(view); }));
  };
  const auto end_oldest = [&]() -> Expected<void> {
    QUORUM_TRY(next_of(writing));
    run.progress.step();
    return {};
  };
  for (const int view : views) {
    if (run.progress.stop_requested()) return std::unexpected(stopped());
    read_ahead();
    auto input = next_of(reading);
    read_ahead();
    if (!input) return std::unexpected(input.error());
    auto output = [&] {
      const StageTimer timer(run.report, stages.work);
      return work(view, *input);
    }();
    if (!output) return std::unexpected(output.error().within(run.view(view).name));
    if (writing.size() == in_flight.count) QUORUM_TRY(end_oldest());
    writing.push_back(writers.run([&write, view, output = *std::move(output)] { return write(view, output); }));
  }
  while (!writing.empty()) QUORUM_TRY(end_oldest());
  if (stages.read != nullptr) add_stage(run.report, readers.time(stages.read));
  if (stages.write != nullptr) add_stage(run.report, writers.time(stages.write));
  return {};
}

/// The same where work gives nothing to write: Expected<void>.
template <typename Read, typename Work>
Expected<void> for_each_view(Run& run, const std::vector<int>& views, const ViewLoopStages& stages, const Read& read,
                             const Work& work) {
  const auto nothing_left = [&](int view, const auto& input) -> Expected<std::monostate> {
    QUORUM_TRY(work(view, input));
    return std::monostate();
  };
  const auto write_nothing = [](int, std::monostate) { return Expected<void>(); };
  return for_each_view(run, views, stages, read, nothing_left, write_nothing);
}

}  // namespace quorum
