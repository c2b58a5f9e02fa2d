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

/// Views that are read ahead, and views that are written behind, each on a thread of its own, at least one; and views
/// that are worked on at once: one, on the calling thread with all cores, or several, on a thread each.
struct ViewsInFlight {
  std::size_t count = 1;
  std::size_t workers = 1;
};

/// One for every four threads of the CPU, and as many as the device works on at once, so that it is not waited for, as
/// long as what the budget spares beside the least holds them and three times as much. each_more: of a view in flight.
ViewsInFlight views_in_flight(const Run& run, const MemoryEstimate& least, const MemoryEstimate& each_more);

/// What is done with a view's output, on the calling thread and in order, before it is written: nothing.
constexpr auto kNothingTold = [](int, const auto&) {};

/// For each of the views, in order: read(view) -> Expected<Input> on a thread beside, work(view, input) ->
/// Expected<Output>, tell(view, output), and write(view, output) -> Expected<void> on another thread beside; with more
/// than one view in flight, reads run at the same time, and so do writes. A step of the progress each, when its view is
/// written. Ends with the first failure, and before the next view if the run is to stop (kStopped); what is worked on
/// before that, or is being written then, is written to its end.
template <typename Read, typename Work, typename Write, typename Tell = decltype(kNothingTold)>
Expected<void> for_each_view(Run& run, const std::vector<int>& views, const ViewLoopStages& stages, const Read& read,
                             const Work& work, const Write& write, ViewsInFlight in_flight = {},
                             const Tell& tell = kNothingTold) {
  using Input = std::invoke_result_t<const Read&, int>::value_type;
  using Output = std::invoke_result_t<const Work&, int, Input&>;
  BackgroundThreads readers(in_flight.count);
  BackgroundThreads writers(in_flight.count);
  BackgroundThreads workers(in_flight.workers > 1 ? in_flight.workers : 0);
  std::deque<std::future<Expected<Input>>> reading;
  std::deque<std::pair<int, std::future<Output>>> working;
  std::deque<std::future<Expected<void>>> writing;
  std::size_t begun = 0;
  const auto read_ahead = [&] {
    for (; begun < views.size() && reading.size() < in_flight.count; ++begun)
      reading.push_back(readers.run([&read, view = views[begun]] { return read(view); }));
  };
  const auto next_input = [&] {
    read_ahead();
    auto input = reading.front().get();
    reading.pop_front();
    read_ahead();
    return input;
  };
  const auto end_oldest = [&]() -> Expected<void> {
    auto written = writing.front().get();
    writing.pop_front();
    if (written) run.progress.step();
    return written;
  };
  const auto write_behind = [&](int view, Output output) -> Expected<void> {
    if (!output) return std::unexpected(output.error().within(run.view(view).name));
    tell(view, *output);
    if (writing.size() == in_flight.count) QUORUM_TRY(end_oldest());
    writing.push_back(writers.run([&write, view, output = *std::move(output)] { return write(view, output); }));
    return {};
  };
  const auto take_oldest = [&]() -> Expected<void> {
    auto [view, output] = std::move(working.front());
    working.pop_front();
    return write_behind(view, output.get());
  };
  for (const int view : views) {
    if (run.progress.stop_requested()) {
      while (!working.empty()) QUORUM_TRY(take_oldest());
      return std::unexpected(stopped());
    }
    auto input = next_input();
    if (!input) {
      while (!working.empty()) QUORUM_TRY(take_oldest());
      return std::unexpected(input.error());
    }
    if (in_flight.workers > 1) {
      if (working.size() == in_flight.workers) QUORUM_TRY(take_oldest());
      working.emplace_back(
          view, workers.run([&work, view, input = *std::move(input)]() mutable { return work(view, input); }));
      continue;
    }
    auto output = [&] {
      const StageTimer timer(run.report, stages.work);
      return work(view, *input);
    }();
    QUORUM_TRY(write_behind(view, std::move(output)));
  }
  while (!working.empty()) QUORUM_TRY(take_oldest());
  while (!writing.empty()) QUORUM_TRY(end_oldest());
  if (stages.read != nullptr) add_stage(run.report, readers.time(stages.read));
  if (stages.work != nullptr && in_flight.workers > 1) add_stage(run.report, workers.time(stages.work));
  if (stages.write != nullptr) add_stage(run.report, writers.time(stages.write));
  return {};
}

/// The same where work gives nothing to write: Expected<void>.
template <typename Read, typename Work>
Expected<void> for_each_view(Run& run, const std::vector<int>& views, const ViewLoopStages& stages, const Read& read,
                             const Work& work, ViewsInFlight in_flight = {}) {
  const auto nothing_left = [&](int view, const auto& input) -> Expected<std::monostate> {
    QUORUM_TRY(work(view, input));
    return std::monostate();
  };
  const auto write_nothing = [](int, std::monostate) { return Expected<void>(); };
  return for_each_view(run, views, stages, read, nothing_left, write_nothing, in_flight);
}

}  // namespace quorum
