// What the commands of `quorum` share: how one is called, how it fails, and how it reads its arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include "engine/core/error.h"

namespace quorum {

/// Runs a command: arguments without the program and command name; the result is the exit code.
int reconstruct_command(int argc, char** argv);
int photos_command(int argc, char** argv);
int depth_command(int argc, char** argv);
int fuse_command(int argc, char** argv);
int evaluate_command(int argc, char** argv);
int calibrate_command(int argc, char** argv);
int render_command(int argc, char** argv);
int convert_command(int argc, char** argv);
int synthesize_command(int argc, char** argv);
int experiment_command(int argc, char** argv);
int devices_command(int argc, char** argv);
int bench_command(int argc, char** argv);

/// Parses the arguments into app and, if they are right, runs work. A failure is printed as one line "command: …" on
/// standard error, and its kind is the exit code; --help prints and gives 0.
int run_command(CLI::App& app, int argc, char** argv, const std::function<Expected<void>()>& work);

/// A length: a number in scene units, or with um, mm, cm, m or km, for scenes in meters; "auto" is 0.
/// option: its name, for the message. Fails (kUsage).
Expected<double> parse_length(const std::string& option, const std::string& text);

/// A size of memory in bytes: a number with KiB, MiB, GiB, TiB, kB, MB, GB or TB; "auto" is 0.
/// option: its name, for the message. Fails (kUsage).
Expected<std::uint64_t> parse_size(const std::string& option, const std::string& text);

}  // namespace quorum
