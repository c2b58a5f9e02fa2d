#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "engine/core/did_you_mean.h"
#include "engine/core/option_maker.h"
#include "engine/io/text.h"
#include "host/api/boundary.h"
#include "host/api/options_state.h"

namespace quorum::v0 {
namespace {

/// Those of a whole run: shards are for the program's commands.
std::span<const quorum::RunOption> table() {
  static const std::vector<quorum::RunOption> kTable = [] {
    std::vector<quorum::RunOption> rows = quorum::run_option_table();
    std::erase_if(rows, [](const quorum::RunOption& row) { return row.stage == quorum::RunStage::kShards; });
    return rows;
  }();
  return kTable;
}

std::unexpected<quorum::Error> refuse(std::string_view option, const std::vector<std::string>& words,
                                      std::string_view remedy) {
  return quorum::failure(
      quorum::ErrorKind::kUsage,
      fmt::format("{}{}{}: {}", quorum::option_name(option), words.empty() ? "" : " ", fmt::join(words, " "), remedy));
}

quorum::Expected<const quorum::RunOption*> find_option(std::string_view name) {
  std::vector<std::string> names;
  for (const quorum::RunOption& row : table()) {
    if (row.name == name || row.given_name() == name) return &row;
    names.push_back(row.name);
  }
  return refuse(name, {}, "there is no such option" + quorum::did_you_mean(name, names));
}

/// A switch by its name, or by that under which the command line turns it off.
quorum::Expected<void> take_switch(Options::State& state, const quorum::RunOption& row, std::string_view name,
                                   const std::vector<std::string>& words) {
  if (words.size() != 1 || (words[0] != "true" && words[0] != "false"))
    return refuse(name, words, "give true or false");
  const bool wanted = (words[0] == "true") == (name == row.name);
  if (wanted == row.turns_off)  // as it is by itself
    state.given.erase(row.name);
  else
    state.given[row.name] = {};
  return {};
}

quorum::Expected<void> take(Options::State& state, std::string_view name, const std::vector<std::string>& words) {
  QUORUM_ASSIGN(const quorum::RunOption* row, find_option(name));
  if (row->most_words == 0) return take_switch(state, *row, name, words);
  const auto count = static_cast<int>(words.size());
  if (count < row->least_words || count > row->most_words || words[0].empty())
    return refuse(name, words, "give " + row->values);
  quorum::RunOptions tried;
  QUORUM_TRY(row->parse(tried, words));
  state.given[row->name] = words;
  return {};
}

/// Words with spaces between them, where an option takes several.
std::vector<std::string> split(std::string_view name, std::string_view value) {
  const auto row = find_option(name);
  if (!row || (*row)->most_words < 2) return {std::string(value)};
  std::vector<std::string> words;
  for (const std::string_view word : quorum::split_tokens(value)) words.emplace_back(word);
  return words;
}

}  // namespace

std::vector<OptionInfo> list_options() {
  std::vector<OptionInfo> options;
  const quorum::RunOptions defaults;
  for (const quorum::RunOption& row : table())
    options.push_back({row.name, row.values, row.text(defaults), row.help,
                       std::string(quorum::stage_heading(row.stage)), row.most_words == 0});
  return options;
}

Options::Options() : state_(std::make_shared<const State>()) {}

Options& Options::set_words(std::string_view name, const std::vector<std::string>& words) {
  if (state_->failure) return *this;
  State next = *state_;
  if (const auto taken = take(next, name, words); !taken) next.failure = taken.error();
  state_ = std::make_shared<const State>(std::move(next));
  return *this;
}

Options& Options::set(std::string_view name, std::string_view value) { return set_words(name, split(name, value)); }

Options& Options::set(std::string_view name, const std::vector<double>& values) {
  std::vector<std::string> words;
  for (const double value : values) words.push_back(quorum::shortest_text(value));
  return set_words(name, words);
}

Options& Options::set_switch(std::string_view name, bool value) { return set_words(name, {value ? "true" : "false"}); }

Options& Options::set_number(std::string_view name, double value) {
  return set_words(name, {quorum::shortest_text(value)});
}

Options& Options::set_integer(std::string_view name, std::int64_t value) {
  return set_words(name, {quorum::shortest_text(value)});
}

Result<std::string> Options::get(std::string_view name) const {
  return at_boundary<std::string>([&]() -> quorum::Expected<std::string> {
    QUORUM_ASSIGN(const quorum::RunOption* row, find_option(name));
    QUORUM_ASSIGN(const quorum::RunOptions options, run_options_of(*this));
    return row->text(options);
  });
}

Result<void> Options::check() const {
  return at_boundary<void>([&]() -> quorum::Expected<void> {
    QUORUM_TRY(run_options_of(*this));
    return {};
  });
}

quorum::Expected<quorum::RunOptions> run_options_of(const Options& options) {
  const Options::State& state = options.state();
  if (state.failure) return std::unexpected(*state.failure);
  quorum::RunOptions run;
  // In the order of the table, where what gives several values stands before these.
  for (const quorum::RunOption& row : table())
    if (const auto found = state.given.find(row.name); found != state.given.end())
      QUORUM_TRY(row.parse(run, found->second));
  QUORUM_TRY(run.check());
  return run;
}

bool is_given(const Options& options, std::string_view name) {
  return options.state().given.find(name) != options.state().given.end();
}

}  // namespace quorum::v0
