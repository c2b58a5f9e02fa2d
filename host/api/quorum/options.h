// The options of a run, by their names: those of `quorum reconstruct` (docs/options.md), with the same defaults.
#pragma once

#include <quorum/result.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace quorum::v0 {

/// What is known of an option.
struct OptionInfo {
  std::string name;        ///< "voxel-size"
  std::string values;      ///< what it takes: "3 to 15, odd"; empty for a switch
  std::string usual;       ///< its default, as text; empty if it has none
  std::string help;        ///< what it is for, with its unit
  std::string heading;     ///< what it and those beside it are about
  bool is_switch = false;  ///< true or false
};

/// All options, those of the scene first.
QUORUM_API std::vector<OptionInfo> list_options();

/// Options of a run. Each set() is checked at once; after the first one that fails all do nothing, and check(), or the
/// call that is given the options, tells it:
///   quorum::Options options;
///   options.set("device", "cpu").set("neighbors", 6).set("fill-holes", true).set("voxel-size", 0.0005);
/// The order of different options does not matter: "quality" gives several of them values, and those that are set
/// overrule it. Of one option the last value counts. Copies are independent.
class QUORUM_API Options {
 public:
  Options();

  /// A value as it would be typed: a number, a length such as "0.5mm", a size such as "4GiB", a name, a file, or
  /// several words with spaces between them ("bounds", "tile"). A switch takes "true" or "false".
  Options& set(std::string_view name, std::string_view value);
  /// A switch ("fill-holes", "confirm"), or a number in the unit that the option states.
  template <typename Value>
  requires std::is_arithmetic_v<Value> Options& set(std::string_view name, Value value) {
    if constexpr (std::is_same_v<Value, bool>)
      return set_switch(name, value);
    else if constexpr (std::is_floating_point_v<Value>)
      return set_number(name, static_cast<double>(value));
    else
      return set_integer(name, static_cast<std::int64_t>(value));
  }
  /// Several numbers ("bounds", "tile").
  Options& set(std::string_view name, const std::vector<double>& values);

  /// The value as text, as docs/options.md shows defaults; switches as "true" or "false", empty for what has none.
  /// Fails (kUsage) if there is no such option, or as check().
  [[nodiscard]] Result<std::string> get(std::string_view name) const;

  /// The first set() that failed (kUsage: no such option, or a value out of its range), or what options must fit of
  /// each other.
  [[nodiscard]] Result<void> check() const;

  struct State;  ///< for the library itself
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  Options& set_words(std::string_view name, const std::vector<std::string>& words);
  Options& set_switch(std::string_view name, bool value);
  Options& set_number(std::string_view name, double value);
  Options& set_integer(std::string_view name, std::int64_t value);

  std::shared_ptr<const State> state_;
};

}  // namespace quorum::v0
