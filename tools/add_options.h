// Options of the engine's tables as flags of a command.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "engine/core/option.h"
#include "engine/pipeline/run_options.h"
#include "tools/command.h"

namespace quorum {

/// Adds an option of options, which outlive line; its value there is what is told as the default.
template <typename Options>
void add_option(CommandLine& line, Options& options, const Option<Options>& option,
                std::string_view group = "Options") {
  line.add_flag({option.given_name(), option.values, option.most_words > 0 ? option.text(options) : std::string(),
                 option.help, std::string(group), option.least_words, option.most_words,
                 [&options, option](const std::vector<std::string>& words) { return option.parse(options, words); }});
}

/// Adds the options of a run of these stages, but those named in without.
void add_run_options(CommandLine& line, RunOptions& options, const std::vector<RunStage>& stages,
                     const std::vector<std::string_view>& without = {});
/// Adds the options of a run of these names.
void add_named_options(CommandLine& line, RunOptions& options, const std::vector<std::string_view>& names);

}  // namespace quorum
