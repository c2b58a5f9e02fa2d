// Options of the engine's tables as flags of a command.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "engine/core/option.h"
#include "engine/pipeline/run_options.h"
#include "tools/command.h"

namespace quorum {

/// What CLI11 needs of an option: usual is the value where the flag is not given.
struct Flag {
  std::string name;
  std::string values;
  std::string usual;
  std::string help;
  std::string group;
  int least_words = 1;
  int most_words = 1;
  std::function<Expected<void>(const std::vector<std::string>&)> take;
};
void add_flag(CLI::App& app, const Flag& flag);

/// Adds an option of options, which outlive app; its value there is what is told as the default.
template <typename Options>
void add_option(CLI::App& app, Options& options, const Option<Options>& option, std::string_view group = "Options") {
  add_flag(app, {option.given_name(), option.values, option.most_words > 0 ? option.text(options) : std::string(),
                 option.help, std::string(group), option.least_words, option.most_words,
                 [&options, option](const std::vector<std::string>& words) { return option.parse(options, words); }});
}

/// Adds the options of a run of these stages, but those named in without.
void add_run_options(CLI::App& app, RunOptions& options, const std::vector<RunStage>& stages,
                     const std::vector<std::string_view>& without = {});
/// Adds the options of a run of these names.
void add_named_options(CLI::App& app, RunOptions& options, const std::vector<std::string_view>& names);

}  // namespace quorum
