#include "tools/colmap_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "engine/io/file.h"

extern char** environ;

namespace quorum {
namespace {

/// Ends a process and those that it started: asked first, then at once.
void end_group(pid_t process) {
  ::kill(-process, SIGTERM);
  for (int wait = 0; wait < 100 && ::waitpid(process, nullptr, WNOHANG) == 0; ++wait) ::usleep(10'000);
  ::kill(-process, SIGKILL);
  ::waitpid(process, nullptr, 0);
}

/// Of the names that a switch has in different versions of colmap the one that the installed one's help lists; none
/// where it lists none.
Expected<std::string> installed_name(const std::string& command, std::initializer_list<const char*> names,
                                     const std::filesystem::path& work, const Progress& progress) {
  const std::filesystem::path help = work / (command + ".help");
  QUORUM_TRY(call_colmap({command, "-h"}, help, progress));
  QUORUM_ASSIGN(const auto text, read_file(help));
  for (std::string name : names)
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const char next = at + name.size() < text.size() ? text[at + name.size()] : ' ';
      if (next == ' ' || next == '\n' || next == '=' || next == '\t' || next == '\r') return name;
    }
  return std::string();
}

}  // namespace

Error stopped_by_request() { return {ErrorKind::kStopped, "stopped as asked; finished steps are kept"}; }

Expected<int> call_colmap(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                          const Progress& progress) {
  std::vector<std::string> words = {"colmap"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::posix_spawn_file_actions_adddup2(&actions, 1, 2);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::setenv("QT_QPA_PLATFORM", "offscreen", 0);  // it asks for a display even where it shows nothing
  pid_t process = 0;
  const int problem = ::posix_spawnp(&process, "colmap", &actions, &attributes, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::posix_spawnattr_destroy(&attributes);
  if (problem == ENOENT)
    return failure(ErrorKind::kInput,
                   "colmap is not installed; install it (Debian: apt install colmap), or give photographs with known "
                   "cameras to quorum reconstruct");
  if (problem != 0) return failure(ErrorKind::kInput, fmt::format("colmap can't be started (error {})", problem));
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process || (ended < 0 && errno != EINTR)) return status;
    if (progress.stop_requested()) {
      end_group(process);
      return std::unexpected(stopped_by_request());
    }
    ::usleep(20'000);
  }
}

Expected<std::vector<std::string>> without_gpu(const std::string& command, std::initializer_list<const char*> names,
                                               const std::filesystem::path& work, const Progress& progress) {
  QUORUM_ASSIGN(const auto name, installed_name(command, names, work, progress));
  return name.empty() ? std::vector<std::string>() : std::vector<std::string>{name, "0"};
}

}  // namespace quorum
