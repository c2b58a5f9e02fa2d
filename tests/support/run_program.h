// Runs a program as a user does, and keeps what it says.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/test_support.h"

namespace quorum {

struct ProgramSetting {
  std::vector<std::pair<std::string, std::string>> environment = {};  ///< added to the test's own
  std::uint64_t file_size_limit = 0;                                  ///< bytes that a file may have; 0 = no limit
  std::uint64_t stack_limit = 0;                                      ///< bytes of a stack; 0 = no other limit
  bool stack_limit_stays = false;                                     ///< the program may not raise it
  std::string out = {};  ///< a file for standard output, whose text is not kept then; "-" closes it
  std::string err = {};  ///< the same for standard error
};

/// exit_code: 128 + signal if a signal ended it, 127 if it could not be started.
struct ProgramResult {
  int exit_code = 0;
  std::string out;
  std::string err;
};

/// A program in a process of its own. Sanitized programs don't look for leaks: Vulkan drivers keep memory.
class Program {
 public:
  Program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
          const ProgramSetting& setting = {});
  ~Program();  ///< kills it if it still runs
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) const;
  /// Waits until it ends. Once.
  ProgramResult wait();

 private:
  TemporaryFolder folder_;
  pid_t process_ = -1;
};

/// A program that was built beside the running test.
std::filesystem::path built_program(const std::string& name);

/// Whether a process of this group still runs. One that has ended and that nobody has waited for does not: where the
/// first process of a container takes over orphans, it may never wait.
bool group_runs(pid_t group);

/// All bytes of a file; empty if there is none.
std::string file_bytes(const std::filesystem::path& path);

}  // namespace quorum
