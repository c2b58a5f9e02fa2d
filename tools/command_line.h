// The words of a command: which there are, and where they go. CLI11 stands behind this in command_line.cc alone, for
// each file that includes it takes the compiler twenty seconds.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace quorum {

/// Part of a command line: a word, or an option that takes some. Each call returns the part itself.
class Argument {
 public:
  explicit Argument(CLI::Option& option) : option_(option) {}
  const Argument& required() const;
  const Argument& takes(int least_words, int most_words) const;
  const Argument& one_of(const std::vector<std::string>& values) const;
  const Argument& between(int least, int most) const;
  const Argument& shown_as(const std::string& values) const;  ///< what --help tells of its value
  const Argument& with_default() const;                       ///< --help tells the value that it has now

 private:
  CLI::Option& option_;
};

/// An option whose words are given to a function; usual is the value where the option is not given.
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

/// What became of the words of a command.
enum class Parsed {
  kDone,  ///< they are right
  kShown  ///< --help or --describe was asked for, and printed
};

class CommandLine {
 public:
  CommandLine(const std::string& description, std::string name);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  ~CommandLine();

  /// Adds a word ("scene") or an option ("-o,--output") whose value goes to a variable that outlives this.
  Argument add(const std::string& names, std::string& value, const std::string& help);
  Argument add(const std::string& names, std::filesystem::path& value, const std::string& help);
  Argument add(const std::string& names, int& value, const std::string& help);
  Argument add(const std::string& names, std::vector<std::string>& value, const std::string& help);
  /// Adds an option without a value.
  void add_switch(const std::string& names, bool& value, const std::string& help);
  void add_flag(const Flag& flag);
  /// Text at the end of --help.
  void add_footer(const std::string& text);

  [[nodiscard]] const std::string& name() const { return name_; }

  /// Puts the words into their variables. Fails (kUsage) with a line that ends in "see quorum NAME --help".
  Expected<Parsed> parse(int argc, char** argv);

 private:
  std::string name_;
  std::unique_ptr<CLI::App> app_;
};

}  // namespace quorum
