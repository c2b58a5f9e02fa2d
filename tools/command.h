// What the commands of `quorum` share: how one is called, how it fails, and how it reads its arguments.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "tools/command_line.h"

namespace quorum {

/// Runs a command: arguments without the program and command name; the result is the exit code.
int reconstruct_command(int argc, char** argv);
int photos_command(int argc, char** argv);
int depth_command(int argc, char** argv);
int confirm_command(int argc, char** argv);
int fuse_command(int argc, char** argv);
int join_command(int argc, char** argv);
int submit_command(int argc, char** argv);
int plan_command(int argc, char** argv);
int status_command(int argc, char** argv);
int evaluate_command(int argc, char** argv);
int calibrate_command(int argc, char** argv);
int render_command(int argc, char** argv);
int simplify_command(int argc, char** argv);
int texture_command(int argc, char** argv);
int report_command(int argc, char** argv);
int convert_command(int argc, char** argv);
int synthesize_command(int argc, char** argv);
int experiment_command(int argc, char** argv);
int devices_command(int argc, char** argv);
int bench_command(int argc, char** argv);
int verify_command(int argc, char** argv);

/// Parses the arguments into line and, if they are right, runs work. A failure is printed as one line "command: …" on
/// standard error, and its kind is the exit code; --help prints and gives 0. Results that could not be written are a
/// failure (kInput); so is an empty word among the arguments (kUsage). Exceptions pass.
int run_command(CommandLine& line, int argc, char** argv, const std::function<Expected<void>()>& work);

/// Prints a failure as that line; the result is the exit code: 128 + signal if a signal stopped the run, else its kind.
int fail(std::string_view command, const Error& error);

/// Fails (kUsage) if the output is one of the inputs, under this or another name. Empty inputs and absent files are
/// none.
Expected<void> check_not_input(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

}  // namespace quorum
