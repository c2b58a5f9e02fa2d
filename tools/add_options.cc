#include "tools/add_options.h"

#include <algorithm>

namespace quorum {
void add_run_options(CommandLine& line, RunOptions& options, const std::vector<RunStage>& stages,
                     const std::vector<std::string_view>& without) {
  for (const RunOption& option : run_option_table())
    if (std::ranges::count(stages, option.stage) > 0 && std::ranges::count(without, option.name) == 0)
      add_option(line, options, option, stage_heading(option.stage));
}

void add_named_options(CommandLine& line, RunOptions& options, const std::vector<std::string_view>& names) {
  for (const RunOption& option : run_option_table())
    if (std::ranges::count(names, option.name) > 0) add_option(line, options, option, stage_heading(option.stage));
}

}  // namespace quorum
