#include "engine/pipeline/confirm_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/mesh/drop_specks.h"
#include "engine/pipeline/certainty_rounds.h"
#include "engine/pipeline/compute_depth_maps.h"
#include "engine/pipeline/provenance.h"
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

/// The depth maps that were read last, since neighboring views ask for the same ones. For one thread.
class RecentDepths {
 public:
  explicit RecentDepths(const Run& run) : run_(run) {}

  Expected<Grid<float>> load(int view) {
    const auto known = std::ranges::find(recent_, view, &Entry::view);
    if (known != recent_.end()) {
      std::rotate(recent_.begin(), known, known + 1);
      return recent_.front().depth;
    }
    const View& source = run_.view(view);
    QUORUM_ASSIGN(auto depth, run_.workspace.load_depth(source.name, source.width, source.height));
    if (recent_.size() == kRecentDepthMaps) recent_.pop_back();
    recent_.insert(recent_.begin(), {view, depth});
    return depth;
  }

 private:
  struct Entry {
    int view;
    Grid<float> depth;
  };
  const Run& run_;
  std::vector<Entry> recent_;  ///< the last one first
};

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

/// A view and those that it is compared with; certainties are those of the round before, if there was one.
Expected<ConfirmTask> read_task(const Run& run, RecentDepths& depths, const CertaintyRounds& certainties, int round,
                                int view, const std::vector<int>& others) {
  const auto read = [&](int index) -> Expected<ViewDepths> {
    QUORUM_ASSIGN(auto depth, depths.load(index));
    ViewDepths result{std::move(depth), run.view(index).camera};
    if (round == 0) return result;
    QUORUM_ASSIGN(result.certainty, certainties.load(round - 1, index));
    leave_out_dropped(result.certainty, result.depth);
    return result;
  };
  QUORUM_ASSIGN(auto own, read(view));
  ConfirmTask task{std::move(own), {}, run.options.fusion};
  for (const int other : others) {
    QUORUM_ASSIGN(auto other_depths, read(other));
    task.others.push_back(std::move(other_depths));
  }
  return task;
}

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

/// The certainty of these views, round by round.
Expected<void> confirm_round_by_round(Run& run, const std::vector<int>& missing,
                                      const std::map<int, std::string>& records, Comparisons& comparisons) {
  const int rounds = run.options.confirm_rounds;
  const auto worked_on = [&](int round) { return comparisons.reach(missing, rounds - round); };
  std::size_t steps = 0;
  for (int round = 0; round <= rounds; ++round) steps += worked_on(round).size();
  run.progress.stage("confirming depths", static_cast<int>(steps));
  QUORUM_ASSIGN(const auto certainties, CertaintyRounds::create(run));
  RecentDepths depths(run);
  for (int round = 0; round <= rounds; ++round) {
    const std::vector<int> views = worked_on(round);
    for (const int view : views) comparisons.others(view);  // before threads ask
    const auto read = [&](int view) {
      return read_task(run, depths, certainties, round, view, comparisons.others(view));
    };
    const auto confirm = [&](int view, const ConfirmTask& task) -> Expected<Grid<float>> {
      const Grid<float>& depth = task.view.depth;
      QUORUM_ASSIGN(Grid<float> certainty, run.backend.confirm_depths(task));
      const float max_step =
          make_range_surface_params(task.view.camera, depth.width, depth.height, task.fusion).max_step;
      drop_specks(depth, max_step, std::min(run.options.min_patch, most_speck_pixels(depth)), certainty);
      constexpr float kConfirmed = 0.6F;  // by one other view, and no other one looks through
      if (round == 0 && std::ranges::binary_search(missing, view)) run.report.compared_depths += count_above(depth, 0);
      if (round == rounds) run.report.confirmed_depths += count_above(certainty, kConfirmed);
      return certainty;
    };
    const auto save = [&](int view, const Grid<float>& certainty) {
      return round < rounds
                 ? certainties.save(round, view, certainty)
                 : run.workspace.save_certainty(run.view(view).name, certainty, records.at(view), run.options.previews);
    };
    QUORUM_TRY(for_each_view(run, views, {"load_depth_maps", "confirm_depths", "save_certainty"}, read, confirm, save));
  }
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
  QUORUM_TRY(run.require(confirm_memory(run.scene, views, run.backend), "confirming depths"));
  return confirm_round_by_round(run, missing, records, comparisons);
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
