#include "tools/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "engine/core/did_you_mean.h"
#include "engine/core/option.h"
#include "tools/messages.h"
#include "tools/signals.h"

namespace quorum {

int fail(std::string_view command, const Error& error) {
  tell(fmt::format("{}: {}", command, error.message));
  return error.kind == ErrorKind::kStopped && stop_signal() != 0 ? 128 + stop_signal() : static_cast<int>(error.kind);
}

namespace {

/// For the first word that looks like an option and is none.
std::string suggest_option(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
    if (word.starts_with("--") && std::ranges::count(names, word) == 0) return did_you_mean(word, names);
  }
  return "";
}

/// The command and its options for scripts that make manual pages and completions of them (cmake/packaging): a line
/// each, with tabs between names, what they take, their group and their help. "-" stands for nothing.
std::string describe(const CLI::App& app) {
  const auto or_dash = [](const std::string& text) { return text.empty() ? std::string("-") : text; };
  std::string lines = fmt::format("{}\t-\t-\t{}\n", app.get_name(), app.get_description());
  for (const CLI::Option* option : app.get_options()) {
    std::string takes = option->get_option_text();
    if (takes.empty() && option->get_items_expected_max() > 0) takes = option->get_type_name();
    const std::string group = option->get_positional() ? "Positionals" : option->get_group();
    lines += fmt::format("{}\t{}\t{}\t{}\n", option->get_name(option->get_positional(), true), or_dash(takes),
                         or_dash(group), or_dash(option->get_description()));
  }
  return lines;
}

/// An empty word is mostly a variable of a shell that was not set: -o "$OUT".
Expected<void> check_words(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& word : option->results())
      if (word.empty())
        return failure(ErrorKind::kUsage,
                       fmt::format("{}: is empty; give a value, or leave it out; see quorum {} --help",
                                   option->get_name(), app.get_name()));
  return {};
}

}  // namespace

Expected<void> check_not_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs) {
  std::error_code ignored;
  for (const std::filesystem::path& input : inputs)
    if (!input.empty() && std::filesystem::equivalent(output, input, ignored))
      return failure(ErrorKind::kUsage,
                     fmt::format("{}: is an input of this command, which would be lost; give the output another name",
                                 output.string()));
  return {};
}

int run_command(CLI::App& app, int argc, char** argv, const std::function<Expected<void>()>& work) {
  set_option_speller([](std::string_view name) { return "--" + std::string(name); });
  if (argc == 2 && std::string_view(argv[1]) == "--describe") {
    write_result(describe(app));
    const auto shown = flush_results();
    return shown ? 0 : fail(app.get_name(), shown.error());
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    write_result(app.help());
    const auto shown = flush_results();
    return shown ? 0 : fail(app.get_name(), shown.error());
  } catch (const CLI::ParseError& error) {
    const bool is_extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    return fail(app.get_name(),
                {ErrorKind::kUsage, fmt::format("{}{}; see quorum {} --help", error.what(),
                                                is_extra ? suggest_option(app, argc, argv) : "", app.get_name())});
  }
  auto done = check_words(app);
  if (done) done = work();
  if (done) done = flush_results();
  return done ? 0 : fail(app.get_name(), done.error());
}

}  // namespace quorum
