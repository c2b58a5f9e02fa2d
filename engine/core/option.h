// An option in one line: its name, the member that holds it, its range, its unit and what it is for. Parsing, checks,
// --help, run.json and the tables of the docs come from that line.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"

namespace quorum {

/// How messages call an option: "option voxel-size", unless set_option_speller() says otherwise.
std::string option_name(std::string_view name);
/// From now on messages call options as the given function does. For programs with a way of their own to give them.
void set_option_speller(std::string (*speller)(std::string_view name));

/// A length as typed: a number in scene units, or with um, mm, cm, m or km, for scenes in meters; "auto" is 0. Empty if
/// it is none, or not above 0.
std::optional<double> parse_length(std::string_view text);
/// A size of memory as typed, bytes: a number with KiB, MiB, GiB, TiB, kB, MB, GB or TB; "auto" is 0. Empty if it is
/// none.
std::optional<std::uint64_t> parse_size(std::string_view text);

/// A count as typed: "500000", "500k" or "1.5M", at least 1. Empty if it is none.
std::optional<std::uint64_t> parse_count(std::string_view text);

/// The range of a number.
struct OptionRange {
  double least = 0.0;
  double most = std::numeric_limits<double>::max();
  bool odd = false;      ///< odd numbers alone
  bool or_zero = false;  ///< 0, too, which means "none" or "automatic"

  [[nodiscard]] bool holds(double value) const {
    if (or_zero && value == 0.0) return true;
    return value >= least && value <= most && (!odd || std::fmod(value, 2.0) == 1.0);
  }
  /// "3 to 15, odd", "16 or more, or 0".
  [[nodiscard]] std::string text() const;
};

/// One option of a struct of options.
template <typename Options>
struct Option {
  std::string name;    ///< in small letters, words joined by -; in files by _
  std::string values;  ///< what it takes, for help and messages; empty for a switch
  std::string help;    ///< what it is for, with its unit
  int least_words = 1;
  int most_words = 1;      ///< 0 = a switch
  bool turns_off = false;  ///< a switch that is on by default; it is given as no-NAME
  bool is_list = false;    ///< text() joins parts by ,
  /// Takes the words of the option. Fails (kUsage), naming it and its range.
  std::function<Expected<void>(Options&, const std::vector<std::string>&)> parse;
  /// As it would be typed; switches as true or false. Empty if it is not given.
  std::function<std::string(const Options&)> text;
  /// Whether a value that was not parsed is in range.
  std::function<bool(const Options&)> holds = [](const Options&) { return true; };

  /// Its name where it is given: NAME, or no-NAME.
  [[nodiscard]] std::string given_name() const { return turns_off ? "no-" + name : name; }
  [[nodiscard]] std::unexpected<Error> refuse(std::string_view value) const {
    return failure(ErrorKind::kUsage, option_name(given_name()) + " " + std::string(value) + ": give " + values);
  }
};

}  // namespace quorum
