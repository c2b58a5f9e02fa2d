#include "tools/command.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "engine/core/option.h"
#include "tools/messages.h"
#include "tools/signals.h"

namespace quorum {

int fail(std::string_view command, const Error& error) {
  tell(fmt::format("{}: {}", command, error.message));
  return error.kind == ErrorKind::kStopped && stop_signal() != 0 ? 128 + stop_signal() : static_cast<int>(error.kind);
}

Expected<void> check_not_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs) {
  std::error_code ignored;
  for (const std::filesystem::path& input : inputs)
    if (!input.empty() && std::filesystem::equivalent(output, input, ignored))
      return failure(ErrorKind::kUsage,
                     fmt::format("{}: is an input of this command, which would be lost; give the output another name",
                                 output.string()));
  return {};
}

int run_command(CommandLine& line, int argc, char** argv, const std::function<Expected<void>()>& work) {
  set_option_speller([](std::string_view name) { return "--" + std::string(name); });
  const auto parsed = line.parse(argc, argv);
  if (!parsed) return fail(line.name(), parsed.error());
  Expected<void> done;
  if (*parsed == Parsed::kDone) done = work();
  if (done) done = flush_results();
  return done ? 0 : fail(line.name(), done.error());
}

}  // namespace quorum
