#include "tests/support/run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace quorum {
namespace {

constexpr unsigned long kCapSysResource = 24;  // CAP_SYS_RESOURCE of <linux/capability.h>, which root has

/// given: the setting, else path.
void redirect(const std::string& given, const std::string& path, int descriptor) {
  if (given == "-") {
    ::close(descriptor);
    return;
  }
  const int file = ::open((given.empty() ? path : given).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ::dup2(file, descriptor);
  ::close(file);
}

}  // namespace

Program::Program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const ProgramSetting& setting) {
  const std::string out = (folder_.path() / "out").string();
  const std::string err = (folder_.path() / "err").string();
  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> pointers = {name.data()};
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  process_ = ::fork();
  if (process_ < 0) ADD_FAILURE() << "can't start " << name;
  if (process_ != 0) return;
  redirect(setting.out, out, STDOUT_FILENO);
  redirect(setting.err, err, STDERR_FILENO);
  std::signal(SIGHUP, SIG_DFL);  // also where the tests run under nohup
  ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  for (const auto& [variable, value] : setting.environment) ::setenv(variable.c_str(), value.c_str(), 1);
  if (setting.file_size_limit > 0) {
    const rlimit limit{setting.file_size_limit, setting.file_size_limit};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (setting.stack_limit > 0) {
    rlimit limit = {};
    ::getrlimit(RLIMIT_STACK, &limit);
    limit.rlim_cur = setting.stack_limit;
    if (setting.stack_limit_stays) limit.rlim_max = setting.stack_limit;
    ::setrlimit(RLIMIT_STACK, &limit);
    if (setting.stack_limit_stays) ::prctl(PR_CAPBSET_DROP, kCapSysResource, 0, 0, 0);
  }
  ::execv(name.c_str(), pointers.data());
  ::_exit(127);
}

Program::~Program() {
  if (process_ <= 0) return;
  send(SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void Program::send(int signal) const {
  if (process_ > 0) ::kill(process_, signal);
}

ProgramResult Program::wait() {
  int status = 0;
  const bool ended = process_ > 0 && ::waitpid(process_, &status, 0) == process_;
  process_ = -1;
  const int code = !ended ? 127 : WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return {code, file_bytes(folder_.path() / "out"), file_bytes(folder_.path() / "err")};
}

std::filesystem::path built_program(const std::string& name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

bool group_runs(pid_t group) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    if (std::isdigit(static_cast<unsigned char>(entry.path().filename().string()[0])) == 0) continue;
    const std::string stat = file_bytes(entry.path() / "stat");
    const std::size_t name_end = stat.rfind(')');
    if (name_end == std::string::npos) continue;
    std::istringstream fields(stat.substr(name_end + 1));
    char state = 0;
    pid_t parent = 0;
    pid_t its_group = 0;
    fields >> state >> parent >> its_group;
    if (its_group == group && state != 'Z' && state != 'X') return true;
  }
  return false;
}

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace quorum
