#include "engine/bench/bench_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>

#include "engine/io/file.h"

namespace quorum {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMebibyte = 1 << 20;

/// Columns that a string takes on a terminal: its characters, not its bytes.
std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U; }));
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, columns(text)), ' ');
}

/// A count with three digits and a unit: 248 M.
std::string in_words(double count) {
  const auto scaled = [&](double unit, const char* name) { return fmt::format("{:.3g} {}", count / unit, name); };
  if (count >= 1e9) return scaled(1e9, "G");
  if (count >= 1e6) return scaled(1e6, "M");
  if (count >= 1e3) return scaled(1e3, "k");
  return fmt::format("{:.0f}", count);
}

std::string run_line(const BenchReport& report) {
  return fmt::format("{}: {} views of {} x {}, on {}", report.scene, report.views, report.width, report.height,
                     report.device);
}

/// What a device is asked for, counted, in the order of the report.
struct DeviceCount {
  const char* name;
  const char* text;
  std::uint64_t DeviceWork::*member;
  double unit = 1.0;
};
constexpr std::array kDeviceCounts = {
    DeviceCount{"uploaded_bytes", "uploaded, MiB", &DeviceWork::uploaded_bytes, kMebibyte},
    DeviceCount{"downloaded_bytes", "downloaded, MiB", &DeviceWork::downloaded_bytes, kMebibyte},
    DeviceCount{"submissions", "submissions", &DeviceWork::submissions},
    DeviceCount{"dispatches", "dispatches", &DeviceWork::dispatches},
    DeviceCount{"allocations", "allocations", &DeviceWork::allocations}};

double value_of(const DeviceCount& count, const BenchReport& report) {
  return static_cast<double>(report.device_work.*count.member) / count.unit;
}

BenchReport from_json(const Json& json) {
  BenchReport report;
  report.version = json.at("version");
  report.device = json.at("device");
  report.scene = json.at("scene").at("name");
  report.views = json.at("scene").at("views");
  report.width = json.at("scene").at("width");
  report.height = json.at("scene").at("height");
  report.rates = {json.at("rates").at("operations_per_second"), json.at("rates").at("bytes_per_second")};
  for (const Json& cost : json.at("costs"))
    report.costs.push_back({cost.at("name"), cost.at("unit"), cost.at("units"), cost.at("seconds"),
                            cost.at("operations"), cost.at("bytes"), cost.at("formula"), cost.at("limit_seconds")});
  for (const Json& stage : json.at("stages"))
    report.stages.push_back({stage.at("name"), stage.at("wall_seconds"), stage.at("cpu_seconds")});
  report.wall_seconds = json.at("wall_seconds");
  report.cpu_seconds = json.at("cpu_seconds");
  report.host_seconds = json.value("host_seconds", 0.0);  // older reports have not counted this and what follows
  report.megapixels = json.value("megapixels", 0.0);
  report.bytes_written = json.value("bytes_written", std::uint64_t{0});
  for (const DeviceCount& count : kDeviceCounts)
    report.device_work.*count.member = json.value("device_work", Json::object()).value(count.name, std::uint64_t{0});
  report.peak_memory_bytes = json.at("peak_memory_bytes");
  return report;
}

}  // namespace

std::string bench_json(const BenchReport& report) {
  Json costs = Json::array();
  for (const Cost& cost : report.costs)
    costs.push_back({{"name", cost.name},
                     {"unit", cost.unit},
                     {"units", cost.units},
                     {"seconds", cost.seconds},
                     {"nanoseconds_per_unit", cost.nanoseconds_per_unit()},
                     {"operations", cost.operations},
                     {"bytes", cost.bytes},
                     {"formula", cost.formula},
                     {"limit_seconds", cost.limit_seconds},
                     {"limit_nanoseconds_per_unit", cost.limit_per_unit()}});
  Json stages = Json::array();
  for (const StageReport& stage : report.stages)
    stages.push_back({{"name", stage.name}, {"wall_seconds", stage.wall_seconds}, {"cpu_seconds", stage.cpu_seconds}});
  Json device_work = Json::object();
  for (const DeviceCount& count : kDeviceCounts) device_work[count.name] = report.device_work.*count.member;
  const Json all = {
      {"version", report.version},
      {"device", report.device},
      {"scene", {{"name", report.scene}, {"views", report.views}, {"width", report.width}, {"height", report.height}}},
      {"rates",
       {{"operations_per_second", report.rates.operations_per_second},
        {"bytes_per_second", report.rates.bytes_per_second}}},
      {"limit", "max(operations / operations_per_second, bytes / bytes_per_second)"},
      {"costs", costs},
      {"stages", stages},
      {"wall_seconds", report.wall_seconds},
      {"cpu_seconds", report.cpu_seconds},
      {"host_seconds", report.host_seconds},
      {"megapixels", report.megapixels},
      {"host_seconds_per_megapixel", report.host_seconds_per_megapixel()},
      {"device_work", device_work},
      {"bytes_written", report.bytes_written},
      {"peak_memory_bytes", report.peak_memory_bytes}};
  return all.dump(2) + "\n";
}

Expected<BenchReport> read_bench(const std::filesystem::path& path) {
  QUORUM_ASSIGN(const auto text, read_file(path));
  try {
    return from_json(Json::parse(text));
  } catch (const Json::exception&) {
    return failure(
        ErrorKind::kInput,
        fmt::format("{}: is no report of quorum bench; give a file that `quorum bench -o` wrote", path.string()));
  }
}

std::string bench_table(const BenchReport& report) {
  std::string text = run_line(report) + "\n\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<15} {:<25} {:>8} {:>11} {:>11} {:>7}\n", "cost", "unit", "units", "ns a unit", "limit, ns",
                 "ratio");
  for (const Cost& cost : report.costs) {
    const double limit = cost.limit_per_unit();
    fmt::format_to(out, "{:<15} {} {:>8} {:>11.4g} ", cost.name, padded(cost.unit, 25), in_words(cost.units),
                   cost.nanoseconds_per_unit());
    if (limit > 0)
      fmt::format_to(out, "{:>11.3g} {:>7.1f}\n", limit, cost.nanoseconds_per_unit() / limit);
    else
      fmt::format_to(out, "{:>11} {:>7}\n", "unknown", "");
  }
  if (report.rates.operations_per_second > 0)
    fmt::format_to(out, "\nlimit = max(operations / {:.3g} G/s, bytes / {:.3g} GB/s), at least:\n",
                   report.rates.operations_per_second / 1e9, report.rates.bytes_per_second / 1e9);
  else
    text += "\nThe rates of this device are not measured. The work takes at least:\n";
  for (const Cost& cost : report.costs) fmt::format_to(out, "  {:<15} {}\n", cost.name, cost.formula);
  fmt::format_to(out, "\n{:<18} {:>10} {:>10} {:>7}\n", "stage", "wall s", "CPU s", "CPU %");
  for (const StageReport& stage : report.stages)
    fmt::format_to(out, "{:<18} {:>10.3f} {:>10.3f} {:>7.1f}\n", stage.name, stage.wall_seconds, stage.cpu_seconds,
                   100.0 * stage.cpu_seconds / report.cpu_seconds);
  fmt::format_to(out, "{:<18} {:>10.3f} {:>10.3f}\n", "whole run", report.wall_seconds, report.cpu_seconds);
  fmt::format_to(out, "outside kernels    {:>10.3f} CPU s a megapixel of {:.1f}\n", report.host_seconds_per_megapixel(),
                 report.megapixels);
  if (report.device_work.submissions > 0)
    for (const DeviceCount& count : kDeviceCounts)
      fmt::format_to(out, "{:<18} {:>10.0f}\n", count.text, value_of(count, report));
  fmt::format_to(out, "files              {:>10.1f} MiB\n", static_cast<double>(report.bytes_written) / kMebibyte);
  fmt::format_to(out, "peak memory        {:>10.0f} MiB\n", static_cast<double>(report.peak_memory_bytes) / kMebibyte);
  return text;
}

std::string compare_table(const BenchReport& before, const BenchReport& after) {
  std::string text = "old  " + run_line(before) + "\nnew  " + run_line(after) + "\n\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<34} {:>11} {:>11} {:>8}\n", "", "old", "new", "new/old");
  const auto row = [&](const std::string& name, double old_value, double new_value) {
    fmt::format_to(out, "{} {:>11.4g} {:>11.4g} ", padded(name, 34), old_value, new_value);
    if (old_value > 0)
      fmt::format_to(out, "{:>8.3f}\n", new_value / old_value);
    else
      fmt::format_to(out, "{:>8}\n", "");
  };
  for (const Cost& cost : before.costs)
    if (const auto other = std::ranges::find(after.costs, cost.name, &Cost::name); other != after.costs.end())
      row(cost.name + ", ns a unit", cost.nanoseconds_per_unit(), other->nanoseconds_per_unit());
  for (const StageReport& stage : before.stages) {
    const auto other = std::ranges::find(after.stages, stage.name, &StageReport::name);
    if (other == after.stages.end()) continue;
    row(stage.name + ", wall s", stage.wall_seconds, other->wall_seconds);
    row(stage.name + ", CPU s", stage.cpu_seconds, other->cpu_seconds);
  }
  row("whole run, wall s", before.wall_seconds, after.wall_seconds);
  row("whole run, CPU s", before.cpu_seconds, after.cpu_seconds);
  if (before.megapixels > 0) {  // older reports have not counted these
    row("outside kernels, CPU s a megapixel", before.host_seconds_per_megapixel(), after.host_seconds_per_megapixel());
    row("files, MiB", static_cast<double>(before.bytes_written) / kMebibyte,
        static_cast<double>(after.bytes_written) / kMebibyte);
  }
  if (before.device_work.submissions > 0)
    for (const DeviceCount& count : kDeviceCounts) row(count.text, value_of(count, before), value_of(count, after));
  row("peak memory, MiB", static_cast<double>(before.peak_memory_bytes) / kMebibyte,
      static_cast<double>(after.peak_memory_bytes) / kMebibyte);
  return text;
}

}  // namespace quorum
