// How the program ends where the system fails it, or asks it to end: a line and a code, and nothing half-written.
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/tools/tool_test.h"

namespace quorum {
namespace {

class Endings : public ToolTest {
 protected:
  void SetUp() override { synthesize(8, 120); }

  std::vector<std::string> reconstruct(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"reconstruct", scene().string(), "-o", result().string(), "--device", "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  [[nodiscard]] std::filesystem::path result() const { return below("result"); }

  /// A run of many seconds that has begun with its views.
  void begin(std::unique_ptr<Program>& program, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = reconstruct({"--threads", "1", "--step-pixels", "0.05"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    program = std::make_unique<Program>(built_program("quorum"), arguments);
    const auto first = result() / "depth" / "temple0001.depth.pfm";
    for (int wait = 0; wait < 6000 && !std::filesystem::exists(first); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(std::filesystem::exists(first));
  }

  void expect_no_temporary_file() {
    for (const auto& [name, bytes] : files_below(result())) EXPECT_FALSE(contains(name, ".tmp")) << name;
  }
};

TEST_F(Endings, MessagesThatCannotBeWrittenEndNoRun) {
  for (const std::string err : {"-", "/dev/full"}) {
    std::filesystem::remove_all(result());
    EXPECT_EQ(quorum_program(reconstruct(), {.err = err}).exit_code, 0) << err;
    EXPECT_TRUE(std::filesystem::exists(result() / "mesh.ply")) << err;
  }
}

TEST_F(Endings, ResultsThatCannotBeWrittenAreTold) {
  const std::vector<std::vector<std::string>> commands = {{"--version"},         {"--help"},
                                                          {"depth", "--help"},   {"devices"},
                                                          {"devices", "--json"}, reconstruct({"--quiet", "--json"})};
  for (const auto& command : commands) {
    expect_failure(quorum_program(command, {.out = "/dev/full"}), 3, {"standard output", "No space left"});
    expect_failure(quorum_program(command, {.out = "-"}), 3, {"standard output"});
  }
}

TEST_F(Endings, StacksThatAreTooSmallAreRaisedOrALine) {
  constexpr std::uint64_t kSmall = 96 << 10;  // at which a run ended by a signal
  EXPECT_EQ(quorum_program(reconstruct({"--quiet"}), {.stack_limit = kSmall}).exit_code, 0);
  const ProgramSetting stays = {.stack_limit = kSmall, .stack_limit_stays = true};
  expect_failure(quorum_program({"devices"}, stays), 5, {"a stack may have 96 KiB here", "ulimit -s"});
}

TEST_F(Endings, TheLimitOnTheSizeOfFilesIsALine) {
  expect_failure(quorum_program(reconstruct({"--quiet"}), {.file_size_limit = 20 << 10}), 3,
                 {"too large", "raise the limit on file sizes"});
  expect_no_temporary_file();
}

TEST_F(Endings, EachSignalHasItsCode) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    std::filesystem::remove_all(result());
    std::unique_ptr<Program> program;
    begin(program, {"--quiet"});
    program->send(signal);
    expect_failure(program->wait(), code, {"stopped"});
    expect_no_temporary_file();
  }
}

TEST_F(Endings, TheFirstInterruptIsAnsweredAtOnceAndTheSecondEndsTheRun) {
  std::unique_ptr<Program> program;
  begin(program);
  program->send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  program->send(SIGINT);
  const ProgramResult ended = program->wait();
  EXPECT_EQ(ended.exit_code, 130);
  EXPECT_TRUE(contains(ended.err, "stopping after this view; again to stop now")) << ended.err;
  expect_no_temporary_file();
}

TEST_F(Endings, CommandsWithoutViewsStopAtOnce) {
  Program program(built_program("quorum"), {"synthesize", below("large").string(), "--views", "300", "--width", "900"});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  program.send(SIGTERM);
  EXPECT_EQ(program.wait().exit_code, 143);
  for (const auto& [name, bytes] : files_below(below("large"))) EXPECT_FALSE(contains(name, ".tmp")) << name;
}

TEST_F(Endings, WhatComesFromFilesTurnsNoTerminal) {
  const ProgramResult refused = quorum_program({"evaluate", "no\x1b[31m\nsuch.ply", (scene() / "gt.ply").string()});
  expect_failure(refused, 3, {"no?[31m?such.ply"});
}

}  // namespace
}  // namespace quorum
