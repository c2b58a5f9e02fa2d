#include "tools/add_options.h"

#include <fmt/format.h>

#include <algorithm>

namespace quorum {
namespace {

void take(const Flag& flag, const std::vector<std::string>& words) {
  if (const auto taken = flag.take(words); !taken) throw CLI::ValidationError(taken.error().message);
}

}  // namespace

void add_flag(CLI::App& app, const Flag& flag) {
  const std::string name = "--" + flag.name;
  CLI::Option* added = nullptr;
  if (flag.most_words == 0)
    added = app.add_flag_callback(
        name, [flag] { take(flag, {}); }, flag.help);
  else if (flag.most_words == 1)
    added = app.add_option_function<std::string>(
        name, [flag](const std::string& word) { take(flag, {word}); }, flag.help);
  else
    added = app.add_option_function<std::vector<std::string>>(
                   name, [flag](const std::vector<std::string>& words) { take(flag, words); }, flag.help)
                ->expected(flag.least_words, flag.most_words);
  if (flag.most_words > 0)
    added->option_text(flag.values + (flag.usual.empty() ? "" : fmt::format(" [{}]", flag.usual)));
  added->group(flag.group);
}

void add_run_options(CLI::App& app, RunOptions& options, const std::vector<RunStage>& stages,
                     const std::vector<std::string_view>& without) {
  for (const RunOption& option : run_option_table())
    if (std::ranges::count(stages, option.stage) > 0 && std::ranges::count(without, option.name) == 0)
      add_option(app, options, option, stage_heading(option.stage));
}

void add_named_options(CLI::App& app, RunOptions& options, const std::vector<std::string_view>& names) {
  for (const RunOption& option : run_option_table())
    if (std::ranges::count(names, option.name) > 0) add_option(app, options, option, stage_heading(option.stage));
}

}  // namespace quorum
