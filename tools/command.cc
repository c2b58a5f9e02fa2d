#include "tools/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <iterator>
#include <new>

namespace quorum {

int run_command(CLI::App& app, int argc, char** argv, const std::function<Expected<void>()>& work) {
  const auto fail = [&](const Error& error) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.message);
    return static_cast<int>(error.kind);
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help());
    return 0;
  } catch (const CLI::ParseError& error) {
    return fail({ErrorKind::kUsage, fmt::format("{}; see quorum {} --help", error.what(), app.get_name())});
  }
  try {
    const auto done = work();
    return done ? 0 : fail(done.error());
  } catch (const std::bad_alloc&) {
    return fail({ErrorKind::kMemory, "out of memory; use fewer or smaller images, or a larger --voxel-size"});
  }
}

Expected<double> parse_length(const std::string& option, const std::string& text) {
  if (text == "auto") return 0.0;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  const double scale = unit.empty() || unit == "m" ? 1.0
                       : unit == "um"              ? 1e-6
                       : unit == "mm"              ? 1e-3
                       : unit == "cm"              ? 1e-2
                       : unit == "km"              ? 1e3
                                                   : 0.0;
  if (problem != std::errc() || scale == 0.0 || !std::isfinite(value) || value <= 0.0)
    return failure(ErrorKind::kUsage,
                   fmt::format("{} {}: give a positive length such as 0.0025 or 2.5mm, or auto", option, text));
  return value * scale;
}

Expected<std::uint64_t> parse_size(const std::string& option, const std::string& text) {
  if (text == "auto") return 0;
  struct Unit {
    std::string_view name;
    double bytes;
  };
  constexpr Unit kUnits[] = {{"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}, {"TiB", 0x1p40},
                             {"kB", 1e3},     {"MB", 1e6},     {"GB", 1e9},     {"TB", 1e12}};
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view name(end, static_cast<std::size_t>(text.data() + text.size() - end));
  const auto unit = std::ranges::find(kUnits, name, &Unit::name);
  const double bytes = unit != std::end(kUnits) ? value * unit->bytes : 0.0;
  if (problem != std::errc() || !(bytes >= 1.0 && bytes < 0x1p60))
    return failure(ErrorKind::kUsage, fmt::format("{} {}: give a size such as 512MiB or 4GiB, or auto", option, text));
  return static_cast<std::uint64_t>(bytes);
}

}  // namespace quorum
