#include "engine/pipeline/special_options.h"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/option_maker.h"
#include "engine/pipeline/parse_bounds.h"

namespace quorum {
namespace {

using Make = OptionMaker<RunOptions>;
using Words = std::vector<std::string>;

}  // namespace

Option<RunOptions> bounds_option(std::string name, std::string help) {
  Option<RunOptions> option = Make::plain(std::move(name), "x0 y0 z0 x1 y1 z1", std::move(help));
  option.most_words = 6;
  option.parse = [name = option.name](RunOptions& options, const Words& words) -> Expected<void> {
    QUORUM_ASSIGN(options.files.bounds, parse_bounds(name, words));
    return {};
  };
  option.text = [](const RunOptions& options) {
    const auto& box = options.files.bounds;
    return box ? fmt::format("{} {} {} {} {} {}", box->low.x(), box->low.y(), box->low.z(), box->high.x(),
                             box->high.y(), box->high.z())
               : std::string();
  };
  return option;
}

Option<RunOptions> weights_option(std::string name, std::string help) {
  constexpr std::pair<std::string_view, bool FusionOptions::*> kFactors[] = {
      {"confidence", &FusionOptions::weigh_confidence},
      {"slant", &FusionOptions::weigh_slant},
      {"border", &FusionOptions::weigh_border}};
  Option<RunOptions> option =
      Make::plain(std::move(name), "confidence, slant and border, joined by commas, or none", std::move(help));
  option.is_list = true;
  option.parse = [kFactors, self = option](RunOptions& options, const Words& words) -> Expected<void> {
    FusionOptions weights = options.fusion;
    std::size_t known = 0;
    const std::string list = "," + words[0] + ",";
    for (const auto& [factor, member] : kFactors) {
      weights.*member = list.find(fmt::format(",{},", factor)) != std::string::npos;
      known += weights.*member ? factor.size() + 1 : 0;
    }
    if (words[0] != "none" && known + 1 != list.size()) return self.refuse(words[0]);
    options.fusion = weights;
    return {};
  };
  option.text = [kFactors](const RunOptions& options) {
    std::string list;
    for (const auto& [factor, member] : kFactors)
      if (options.fusion.*member) list += fmt::format("{}{}", list.empty() ? "" : ",", factor);
    return list.empty() ? std::string("none") : list;
  };
  return option;
}

Option<RunOptions> no_slant_option(std::string help) {
  Option<RunOptions> option = Make::plain("no-slant", "", std::move(help));
  option.least_words = option.most_words = 0;
  option.parse = [](RunOptions& options, const Words&) {
    if (options.sweep.is_slanted()) options.sweep.window_model = WindowModel::kPlane;
    return Expected<void>();
  };
  option.text = [](const RunOptions&) { return std::string(); };
  return option;
}

Option<RunOptions> tile_option(std::string name, std::string help) {
  constexpr OptionRange kWidth{8, 64};
  constexpr OptionRange kHeight{1, 64};
  Option<RunOptions> option =
      Make::plain(std::move(name), fmt::format("{} and {}", kWidth.text(), kHeight.text()), std::move(help));
  option.least_words = option.most_words = 2;
  option.holds = [kWidth, kHeight](const RunOptions& options) {
    return kWidth.holds(options.tile_width) && kHeight.holds(options.tile_height);
  };
  option.text = [](const RunOptions& options) { return fmt::format("{} {}", options.tile_width, options.tile_height); };
  option.parse = [self = option](RunOptions& options, const Words& words) -> Expected<void> {
    options.tile_width = parse_number<int>(words[0]).value_or(0);
    options.tile_height = parse_number<int>(words[1]).value_or(0);
    return self.holds(options) ? Expected<void>() : self.refuse(words[0] + " " + words[1]);
  };
  return option;
}

Option<RunOptions> quality_option(std::string name, std::string help) {
  Option<RunOptions> option = Make::plain(std::move(name), "draft, normal or high", std::move(help));
  option.parse = [self = option](RunOptions& options, const Words& words) -> Expected<void> {
    if (words[0] != "draft" && words[0] != "normal" && words[0] != "high") return self.refuse(words[0]);
    if (words[0] == "draft") {
      options.views.neighbor_count = 3;
      options.sweep.step_pixels = 4.0;
      options.sweep.window_model = WindowModel::kPlane;
    } else if (words[0] == "high") {
      options.views.neighbor_count = 6;
      options.sweep.step_pixels = 1.0;
      options.sweep.second_window = 9;
    }
    return {};
  };
  option.text = [](const RunOptions&) { return std::string(); };
  return option;
}

Option<RunOptions> shard_option(std::string name, std::string help) {
  Option<RunOptions> option =
      Make::plain(std::move(name), fmt::format("I/N, 1/N to N/N, N up to {}", kMostShards), std::move(help));
  option.parse = [self = option](RunOptions& options, const Words& words) -> Expected<void> {
    options.shard = parse_shard(words[0]);
    return options.shard ? Expected<void>() : self.refuse(words[0]);
  };
  option.text = [](const RunOptions& options) { return options.shard ? options.shard->text() : std::string(); };
  return option;
}

Option<RunOptions> triangles_option(std::string name, std::string help) {
  Option<RunOptions> option = Make::plain(std::move(name), "a number such as 200000, 500k or 1.5M", std::move(help));
  option.parse = [self = option](RunOptions& options, const Words& words) -> Expected<void> {
    const auto count = parse_count(words[0]);
    if (!count) return self.refuse(words[0]);
    options.triangles = *count;
    return {};
  };
  option.text = [](const RunOptions& options) {
    return options.triangles > 0 ? shortest_text(options.triangles) : std::string();
  };
  return option;
}

}  // namespace quorum
