#include "engine/pipeline/confirm_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "engine/mesh/drop_specks.h"
#include "engine/pipeline/certainty_rounds.h"
#include "engine/pipeline/compute_depth_maps.h"
#include "engine/pipeline/provenance.h"
#include "engine/pipeline/recently_made.h"
#include "engine/pipeline/view_loop.h"
#include "engine/volume/range_surface.h"

namespace quorum {
namespace {

/// A patch of more is no speck however small the image: else small images would lose all.
int most_speck_pixels(const Grid<float>& depth) { return static_cast<int>(depth.values.size() / 1500); }

/// The other views that a view may be compared with.
std::vector<int> select_candidates(const Run& run, int view) {
  SelectViewsOptions rule = run.options.views;
  rule.neighbor_count = kConfirmingViews;
  return select_views(run.scene, view, rule);
}

/// Those of them that it is compared with. views: with a depth map, ascending.
std::vector<int> select_others(const Run& run, int view, const std::vector<int>& views) {
  std::vector<int> others = select_candidates(run, view);
  std::erase_if(others, [&](int other) { return !std::ranges::binary_search(views, other); });
  return others;
}

/// Who is compared with whom.
class Comparisons {
 public:
  /// views: with a depth map, ascending; both outlive the object.
  Comparisons(const Run& run, const std::vector<int>& views) : run_(run), views_(views) {}

  const std::vector<int>& others(int view) {
    const auto [place, is_new] = others_.try_emplace(view);
    if (is_new) place->second = select_others(run_, view, views_);
    return place->second;
  }

  /// These views, those that they are compared with, and so on in so many steps; ascending.
  std::vector<int> reach(const std::vector<int>& from, int steps) {
    std::set<int> reached(from.begin(), from.end());
    std::vector<int> last = from;
    for (; steps > 0 && !last.empty(); --steps) {
      std::vector<int> next;
      for (const int view : last)
        for (const int other : others(view))
          if (reached.insert(other).second) next.push_back(other);
      last = std::move(next);
    }
    return {reached.begin(), reached.end()};
  }

  /// What the certainty of a view was made from.
  std::string record(Provenance& provenance, int view) {
    return provenance.certainty_record(view, others(view), reach({view}, run_.options.confirm_rounds + 1));
  }

 private:
  const Run& run_;
  const std::vector<int>& views_;
  std::map<int, std::vector<int>> others_;
};

/// Reads views as others are compared with them in a round.
class ViewReader {
 public:
  ViewReader(const Run& run, const CertaintyRounds& certainties) : run_(run), certainties_(certainties) {}

  /// A view's depths, with the certainties of the round before, if there was one.
  Expected<std::shared_ptr<const ViewDepths>> load(int round, int view) {
    return recent_.get({round, view}, [&]() -> Expected<std::shared_ptr<const ViewDepths>> {
      const View& source = run_.view(view);
      QUORUM_ASSIGN(auto depth, run_.workspace.load_depth(source.name, source.width, source.height));
      ViewDepths result{std::move(depth), source.camera};
      if (round > 0) {
        QUORUM_ASSIGN(result.certainty, certainties_.load(round - 1, view));
        leave_out_dropped(result.certainty, result.depth);
      }
      return std::make_shared<const ViewDepths>(std::move(result));
    });
  }

  /// A view and those that it is compared with.
  Expected<ConfirmTask> load_task(int round, int view, const std::vector<int>& others) {
    QUORUM_ASSIGN(auto own, load(round, view));
    ConfirmTask task{std::move(own), {}, run_.options.fusion};
    for (const int other : others) {
      QUORUM_ASSIGN(auto seen_by, load(round, other));
      task.others.push_back(std::move(seen_by));
    }
    return task;
  }

 private:
  const Run& run_;
  const CertaintyRounds& certainties_;
  RecentlyMade<std::pair<int, int>, Expected<std::shared_ptr<const ViewDepths>>> recent_{kRecentViews};
};

/// That no depth map is missing that the shard's views need.
Expected<void> check_inputs(const Run& run, const Shard& shard) {
  std::vector<int> all;
  std::vector<int> own;
  for (int view = 0; view < static_cast<int>(run.scene.views.size()); ++view) {
    all.push_back(view);
    if (shard.has(view)) own.push_back(view);
  }
  for (const int view : Comparisons(run, all).reach(own, run.options.confirm_rounds + 1))
    QUORUM_TRY(check_depth_map_is_there(run, view));
  return {};
}

std::uint64_t count_above(const Grid<float>& map, float least) {
  return static_cast<std::uint64_t>(std::ranges::count_if(map.values, [=](float value) { return value > least; }));
}

/// A view, and the certainty of its depths.
struct ConfirmedView {
  std::shared_ptr<const ViewDepths> view;
  Grid<float> certainty;
};

/// The certainty, 0 in small patches that no other view confirms.
Grid<float> without_specks(const Run& run, const ConfirmedView& confirmed) {
  const Grid<float>& depth = confirmed.view->depth;
  Grid<float> certainty = confirmed.certainty;
  const float max_step =
      make_range_surface_params(confirmed.view->camera, depth.width, depth.height, run.options.fusion).max_step;
  drop_specks(depth, max_step, std::min(run.options.min_patch, most_speck_pixels(depth)), certainty);
  return certainty;
}

/// The certainty of these views, round by round.
Expected<void> confirm_round_by_round(Run& run, const std::vector<int>& missing,
                                      const std::map<int, std::string>& records, Comparisons& comparisons,
                                      ViewsInFlight in_flight) {
  const int rounds = run.options.confirm_rounds;
  const auto worked_on = [&](int round) { return comparisons.reach(missing, rounds - round); };
  std::size_t steps = 0;
  for (int round = 0; round <= rounds; ++round) steps += worked_on(round).size();
  run.progress.stage("confirming depths", static_cast<int>(steps));
  QUORUM_ASSIGN(const auto certainties, CertaintyRounds::create(run));
  ViewReader reader(run, certainties);
  std::atomic<std::uint64_t> compared = 0;
  std::atomic<std::uint64_t> agreed = 0;
  for (int round = 0; round <= rounds; ++round) {
    const std::vector<int> views = worked_on(round);
    for (const int view : views) comparisons.others(view);  // before threads ask
    const auto read = [&](int view) { return reader.load_task(round, view, comparisons.others(view)); };
    const auto confirm = [&](int, const ConfirmTask& task) -> Expected<ConfirmedView> {
      QUORUM_ASSIGN(Grid<float> certainty, run.backend.confirm_depths(task));
      return ConfirmedView{task.view, std::move(certainty)};
    };
    const auto save = [&](int view, const ConfirmedView& confirmed) -> Expected<void> {
      const Grid<float> certainty = without_specks(run, confirmed);
      if (round == 0 && std::ranges::binary_search(missing, view)) compared += count_above(confirmed.view->depth, 0);
      if (round < rounds) return certainties.save(round, view, certainty);
      constexpr float kConfirmed = 0.6F;  // by one other view, and no other one looks through
      agreed += count_above(certainty, kConfirmed);
      return run.workspace.save_certainty(run.view(view).name, certainty, records.at(view), run.options.previews);
    };
    QUORUM_TRY(for_each_view(run, views, {"load_depth_maps", "confirm_depths", "save_certainty"}, read, confirm, save,
                             in_flight));
  }
  run.report.compared_depths += compared;
  run.report.confirmed_depths += agreed;
  return {};
}

}  // namespace

Expected<void> confirm_views(Run& run, const std::vector<int>& views) {
  if (!run.options.confirm) {
    for (const int view : views) run.workspace.remove_certainty(run.view(view).name);
    return {};
  }
  const std::optional<Shard>& shard = run.options.shard;
  if (shard) QUORUM_TRY(check_inputs(run, *shard));
  Comparisons comparisons(run, views);
  std::map<int, std::string> records;
  std::vector<int> missing;
  Provenance provenance(run);
  for (const int view : views) {
    if (shard && !shard->has(view)) continue;
    const std::string& record = records[view] = comparisons.record(provenance, view);
    if (record.empty() || run.workspace.certainty_record(run.view(view).name) != record) missing.push_back(view);
  }
  run.report.kept_certainties = static_cast<int>(records.size() - missing.size());
  if (missing.empty()) return {};
  const MemoryEstimate least = confirm_memory(run.scene, views, run.backend);
  QUORUM_TRY(run.require(least, "confirming depths"));
  const ViewsInFlight in_flight = views_in_flight(run, least, confirm_in_flight_memory(run.scene, views, run.backend));
  return confirm_round_by_round(run, missing, records, comparisons, in_flight);
}

Expected<void> check_certainties(const Run& run, const std::vector<int>& views) {
  for (int view = 0; view < static_cast<int>(run.scene.views.size()); ++view)
    QUORUM_TRY(check_depth_map_is_there(run, view));
  if (!run.options.confirm) return {};
  Provenance provenance(run);
  Comparisons comparisons(run, views);
  for (const int view : views) {
    const std::string& name = run.view(view).name;
    const std::string record = comparisons.record(provenance, view);
    if (record.empty() || run.workspace.certainty_record(name) != record)
      return failure(ErrorKind::kInput,
                     fmt::format("{}: the certainty of {} is missing, or was made of other depth maps or options; run "
                                 "`quorum confirm` with the same options: what is there is kept",
                                 run.workspace.folder().string(), name));
  }
  return {};
}

}  // namespace quorum
