#include "engine/core/option.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <span>

#include "engine/core/option_maker.h"

namespace quorum {
namespace {

std::string spell_plainly(std::string_view name) { return "option " + std::string(name); }

std::string (*speller)(std::string_view name) = spell_plainly;

struct Unit {
  std::string_view name;
  double scale;
};

/// The number at the start of the text times the unit after it; 0 if either is none.
double parse_with_unit(std::string_view text, std::span<const Unit> units) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc()) return 0.0;
  const auto unit = std::ranges::find(units, text.substr(static_cast<std::size_t>(end - text.data())), &Unit::name);
  return unit != units.end() ? value * unit->scale : 0.0;
}

}  // namespace

std::string option_name(std::string_view name) { return speller(name); }

void set_option_speller(std::string (*function)(std::string_view name)) { speller = function; }

std::optional<double> parse_length(std::string_view text) {
  constexpr Unit kUnits[] = {{"", 1.0}, {"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"km", 1e3}};
  if (text == "auto") return 0.0;
  const double length = parse_with_unit(text, kUnits);
  return length > 0.0 && std::isfinite(length) ? std::optional(length) : std::nullopt;
}

std::optional<std::uint64_t> parse_size(std::string_view text) {
  constexpr Unit kUnits[] = {{"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}, {"TiB", 0x1p40},
                             {"kB", 1e3},     {"MB", 1e6},     {"GB", 1e9},     {"TB", 1e12}};
  if (text == "auto") return 0;
  const double bytes = parse_with_unit(text, kUnits);
  return bytes >= 1.0 && bytes < 0x1p60 ? std::optional(static_cast<std::uint64_t>(bytes)) : std::nullopt;
}

std::optional<std::uint64_t> parse_count(std::string_view text) {
  const double factor = text.ends_with('k') ? 1e3 : text.ends_with('M') ? 1e6 : 1;
  if (factor > 1) text.remove_suffix(1);
  const auto number = parse_number<double>(text);
  if (!number || !(*number * factor >= 1 && *number * factor <= 1e12)) return std::nullopt;
  return static_cast<std::uint64_t>(*number * factor);
}

std::string OptionRange::text() const {
  const auto number = [](double value) {
    return value == std::floor(value) ? std::to_string(static_cast<std::int64_t>(value)) : shortest_text(value);
  };
  std::string text = number(least);
  text += most < std::numeric_limits<double>::max() ? " to " + number(most) : " or more";
  if (odd) text += ", odd";
  if (or_zero) text += ", or 0";
  return text;
}

}  // namespace quorum
