#include "engine/io/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "engine/io/file.h"

namespace quorum {

namespace fs = std::filesystem;

/// A temporary file that is there, for remove_temporary_files(): a signal handler can take no lock.
struct LivePath {
  std::atomic<bool> taken = false;
  std::atomic<bool> there = false;
  char path[PATH_MAX] = {};
};

namespace {

LivePath live_paths[64];
std::atomic<bool> is_ending = false;
std::atomic<int> creations = 0;  // threads between the making of a file and its entry in live_paths

/// A place for the path, or null if all are taken or the path is too long.
LivePath* note_live(const fs::path& path) {
  if (path.native().size() >= PATH_MAX) return nullptr;
  for (LivePath& live : live_paths) {
    if (live.taken.exchange(true)) continue;
    path.native().copy(live.path, PATH_MAX - 1);
    live.path[path.native().size()] = '\0';
    live.there = true;
    return &live;
  }
  return nullptr;
}

/// Keeps signals from this thread, and remove_temporary_files() waiting, until a new file stands in live_paths.
class Creation {
 public:
  Creation() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
    ++creations;
    if (!is_ending) return;
    --creations;
    while (true) ::pause();
  }
  Creation(const Creation&) = delete;
  Creation& operator=(const Creation&) = delete;
  ~Creation() {
    const int code = errno;
    --creations;
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = code;
  }

 private:
  sigset_t before_;
};

/// Another process, perhaps on another machine, can have the same number and have left or be writing the same name:
/// O_EXCL sees that, and the next name is tried.
int create(const fs::path& folder, fs::path& path, LivePath*& live) {
  static std::atomic<unsigned> counter = 0;
  while (true) {
    path = folder / fmt::format(".quorum-{}-{}.tmp", ::getpid(), counter++);
    const Creation creation;
    const int value = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (value >= 0) live = note_live(path);
    if (value >= 0 || errno != EEXIST) return value;
  }
}

std::string program_of(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/comm", process));
  std::string name;
  std::getline(file, name);
  return name;
}

/// Whether a file of this name was left by a process that does not run any more.
bool is_left_over(const std::string& name) {
  constexpr std::string_view kBegin = ".quorum-";
  if (!name.starts_with(kBegin) || !name.ends_with(".tmp")) return false;
  const pid_t process = std::atoi(name.c_str() + kBegin.size());
  return process > 0 && (process == ::getpid() || program_of(process) != program_of(::getpid()));
}

}  // namespace

Descriptor::~Descriptor() {
  if (value_ >= 0) ::close(value_);
}

TemporaryFile::TemporaryFile(const fs::path& folder) : live_(nullptr), descriptor_(create(folder, path_, live_)) {}

TemporaryFile::~TemporaryFile() {
  if (descriptor_.get() >= 0 && !renamed_) ::unlink(path_.c_str());
  if (live_ == nullptr) return;
  live_->there = false;
  live_->taken = false;
}

bool TemporaryFile::rename_to(const fs::path& path) {
  renamed_ = ::rename(path_.c_str(), path.c_str()) == 0;
  return renamed_;
}

void remove_temporary_files() noexcept {
  is_ending = true;
  // At most a second: a file system that hangs must not keep the program from its end.
  const timespec millisecond = {0, 1000000};
  for (int wait = 0; wait < 1000 && creations > 0; ++wait) ::nanosleep(&millisecond, nullptr);
  for (const LivePath& live : live_paths)
    if (live.there) ::unlink(live.path);
}

void sweep_temporary_files(const fs::path& folder) {
  std::error_code code;
  for (fs::recursive_directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code))
    if (is_left_over(entry->path().filename().string())) remove_file(entry->path());
}

}  // namespace quorum
