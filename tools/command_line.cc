#include "tools/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "engine/core/did_you_mean.h"
#include "tools/messages.h"

namespace quorum {
namespace {

void take(const Flag& flag, const std::vector<std::string>& words) {
  if (const auto taken = flag.take(words); !taken) throw CLI::ValidationError(taken.error().message);
}

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

const Argument& Argument::required() const {
  option_.required();
  return *this;
}
const Argument& Argument::takes(int least_words, int most_words) const {
  option_.expected(least_words, most_words);
  return *this;
}
const Argument& Argument::one_of(const std::vector<std::string>& values) const {
  option_.check(CLI::IsMember(values));
  return *this;
}
const Argument& Argument::between(int least, int most) const {
  option_.check(CLI::Range(least, most));
  return *this;
}
const Argument& Argument::shown_as(const std::string& values) const {
  option_.option_text(values);
  return *this;
}
const Argument& Argument::with_default() const {
  option_.capture_default_str();
  return *this;
}

CommandLine::CommandLine(const std::string& description, std::string name)
    : name_(std::move(name)), app_(std::make_unique<CLI::App>(description, name_)) {}

CommandLine::~CommandLine() = default;

Argument CommandLine::add(const std::string& names, std::string& value, const std::string& help) {
  return Argument(*app_->add_option(names, value, help));
}
Argument CommandLine::add(const std::string& names, std::filesystem::path& value, const std::string& help) {
  return Argument(*app_->add_option(names, value, help));
}
Argument CommandLine::add(const std::string& names, int& value, const std::string& help) {
  return Argument(*app_->add_option(names, value, help));
}
Argument CommandLine::add(const std::string& names, std::vector<std::string>& value, const std::string& help) {
  return Argument(*app_->add_option(names, value, help));
}

void CommandLine::add_switch(const std::string& names, bool& value, const std::string& help) {
  app_->add_flag(names, value, help);
}

void CommandLine::add_flag(const Flag& flag) {
  const std::string name = "--" + flag.name;
  CLI::Option* added = nullptr;
  if (flag.most_words == 0)
    added = app_->add_flag_callback(
        name, [flag] { take(flag, {}); }, flag.help);
  else if (flag.most_words == 1)
    added = app_->add_option_function<std::string>(
        name, [flag](const std::string& word) { take(flag, {word}); }, flag.help);
  else
    added = app_->add_option_function<std::vector<std::string>>(
                    name, [flag](const std::vector<std::string>& words) { take(flag, words); }, flag.help)
                ->expected(flag.least_words, flag.most_words);
  if (flag.most_words > 0)
    added->option_text(flag.values + (flag.usual.empty() ? "" : fmt::format(" [{}]", flag.usual)));
  added->group(flag.group);
}

void CommandLine::add_footer(const std::string& text) { app_->footer(text); }

Expected<Parsed> CommandLine::parse(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--describe") {
    write_result(describe(*app_));
    return Parsed::kShown;
  }
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    write_result(app_->help());
    return Parsed::kShown;
  } catch (const CLI::ParseError& error) {
    const bool is_extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
    return failure(ErrorKind::kUsage, fmt::format("{}{}; see quorum {} --help", error.what(),
                                                  is_extra ? suggest_option(*app_, argc, argv) : "", name_));
  }
  QUORUM_TRY(check_words(*app_));
  return Parsed::kDone;
}

}  // namespace quorum
