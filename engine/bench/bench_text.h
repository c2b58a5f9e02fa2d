// The benchmark as JSON and as tables for people.
#pragma once

#include <filesystem>
#include <string>

#include "engine/bench/bench_report.h"

namespace quorum {

/// Indented JSON text.
std::string bench_json(const BenchReport& report);

/// A report that bench_json wrote. Fails (kInput) if the file can't be read or is no such report.
Expected<BenchReport> read_bench(const std::filesystem::path& path);

/// Costs beside their limits, and where the run spent its time.
std::string bench_table(const BenchReport& report);

/// Two reports beside each other, with new / old. Rows that only one of them has are left out.
std::string compare_table(const BenchReport& before, const BenchReport& after);

}  // namespace quorum
