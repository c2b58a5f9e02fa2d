// Options as the library keeps them, and as the engine takes them.
#pragma once

#include <quorum/options.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/pipeline/run_options.h"

namespace quorum::v0 {

struct Options::State {
  std::map<std::string, std::vector<std::string>, std::less<>>
      given;                             ///< by name: the words that RunOption::parse takes
  std::optional<quorum::Error> failure;  ///< of the first set() that failed
};

/// The options of a run. Fails (kUsage) as Options::check().
quorum::Expected<quorum::RunOptions> run_options_of(const Options& options);

/// Whether an option has another value than its default by its own name.
bool is_given(const Options& options, std::string_view name);

}  // namespace quorum::v0
