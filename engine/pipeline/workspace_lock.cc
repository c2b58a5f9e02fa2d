#include "engine/pipeline/workspace_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <string>

#include "engine/io/temporary_file.h"

namespace quorum {
namespace {

/// "quorum reconstruct, process 17 on host".
std::string describe_holder(std::string_view command) {
  char host[HOST_NAME_MAX + 1] = "";
  ::gethostname(host, HOST_NAME_MAX);
  return fmt::format("quorum {}, process {} on {}", command, ::getpid(), host);
}

/// What the holder has written.
std::string read_holder(int descriptor) {
  char text[512] = "";
  const ssize_t count = ::pread(descriptor, text, sizeof(text), 0);
  std::string holder(text, static_cast<std::size_t>(count > 0 ? count : 0));
  while (!holder.empty() && holder.back() == '\n') holder.pop_back();
  return holder.empty() ? "one that does not say its name" : holder;
}

/// Whether the file that is open is the one under this path: the last holder may have removed it meanwhile.
bool is_still_there(int descriptor, const std::filesystem::path& path) {
  struct stat open = {};
  struct stat there = {};
  return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &there) == 0 && open.st_ino == there.st_ino &&
         open.st_dev == there.st_dev;
}

}  // namespace

Expected<WorkspaceLock> WorkspaceLock::take_file(const std::filesystem::path& path, int mode, const std::string& holder,
                                                 const std::filesystem::path& folder) {
  while (true) {
    WorkspaceLock lock(path, ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
    if (lock.descriptor_ < 0)
      return failure(
          ErrorKind::kInput,
          fmt::format("{}: cannot be made or written; change the permissions or choose another folder", path.string()));
    if (::flock(lock.descriptor_, mode | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno != EWOULDBLOCK) return lock;
      lock.path_.clear();  // not ours to remove
      return failure(ErrorKind::kInput, fmt::format("{}: another run works here ({}); wait for it, end it, or choose "
                                                    "another output folder",
                                                    folder.string(), read_holder(lock.descriptor_)));
    }
    if (!is_still_there(lock.descriptor_, path)) {
      lock.path_.clear();
      continue;
    }
    // What can't be written only leaves the holder unnamed.
    const std::string line = holder + "\n";
    if (::ftruncate(lock.descriptor_, 0) == 0)
      static_cast<void>(::pwrite(lock.descriptor_, line.data(), line.size(), 0) < 0);
    return lock;
  }
}

Expected<WorkspaceLock> WorkspaceLock::take(const std::filesystem::path& folder, std::string_view command) {
  auto lock = take_file(folder / ".quorum.lock", LOCK_EX, describe_holder(command), folder);
  if (lock) sweep_temporary_files(folder);
  return lock;
}

Expected<WorkspaceLock> WorkspaceLock::take_shard(const std::filesystem::path& folder, std::string_view command,
                                                  const Shard& shard) {
  const std::string holder = fmt::format("{}: shard {}", describe_holder(command), shard.text());
  QUORUM_ASSIGN(WorkspaceLock all, take_file(folder / ".quorum.lock", LOCK_SH, holder, folder));
  all.path_.clear();  // others may hold it; the next run that has it alone removes it
  const std::string name = fmt::format("{}-{}-of-{}.lock", command, shard.index + 1, shard.count);
  QUORUM_ASSIGN(WorkspaceLock lock, take_file(folder / "shards" / name, LOCK_EX, holder, folder));
  lock.shared_ = std::exchange(all.descriptor_, -1);
  return lock;
}

namespace {

/// What the file's holder has written; empty if nobody holds it alone.
std::string holder_of(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return "";
  const bool is_held = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  const std::string holder = is_held ? read_holder(descriptor) : "";
  ::close(descriptor);
  return holder;
}

}  // namespace

std::string WorkspaceLock::holder(const std::filesystem::path& folder) { return holder_of(folder / ".quorum.lock"); }

std::vector<std::string> WorkspaceLock::shard_holders(const std::filesystem::path& folder) {
  std::vector<std::string> holders;
  std::error_code code;
  for (std::filesystem::directory_iterator entry(folder / "shards", code), end; !code && entry != end;
       entry.increment(code)) {
    if (entry->path().extension() != ".lock") continue;
    if (std::string holder = holder_of(entry->path()); !holder.empty()) holders.push_back(std::move(holder));
  }
  std::ranges::sort(holders);
  return holders;
}

WorkspaceLock::~WorkspaceLock() {
  if (descriptor_ < 0) return;
  if (!path_.empty()) ::unlink(path_.c_str());
  ::close(descriptor_);
  if (shared_ >= 0) ::close(shared_);
}

}  // namespace quorum
