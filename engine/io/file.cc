#include "engine/io/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cctype>
#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace quorum {
namespace {

namespace fs = std::filesystem;

const char* remedy(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another output folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return "change the permissions or choose another folder";
    case ENOENT:
      return "check the path";
    case ENOTDIR:
      return "a part of the path is a file, not a folder";
    case EFBIG:
      return "raise the limit on file sizes or choose another output folder";
    default:
      return "check the disk and the path";
  }
}

/// "path: cannot write: no space left on device; free some space or choose another output folder".
std::unexpected<Error> system_failure(const fs::path& path, std::string_view action, int code) {
  std::string reason = std::generic_category().message(code);
  if (!reason.empty()) reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  return failure(ErrorKind::kInput, fmt::format("{}: cannot {}: {}; {}", path.string(), action, reason, remedy(code)));
}

/// An open file descriptor, or -1; closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  [[nodiscard]] int get() const { return value_; }

 private:
  int value_;
};

/// A new file in a folder, removed at the end of its scope unless it was renamed.
class TemporaryFile {
 public:
  /// On failure the descriptor is -1 and errno says why.
  explicit TemporaryFile(const fs::path& folder) : descriptor_(create(folder, path_)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_.get() >= 0 && !renamed_) ::unlink(path_.c_str());
  }

  [[nodiscard]] int descriptor() const { return descriptor_.get(); }
  [[nodiscard]] bool rename_to(const fs::path& path) {
    renamed_ = ::rename(path_.c_str(), path.c_str()) == 0;
    return renamed_;
  }

 private:
  // Another process, perhaps on another machine, can have the same number and have left or be writing the same name:
  // O_EXCL sees that, and the next name is tried.
  static Descriptor create(const fs::path& folder, fs::path& path) {
    static std::atomic<unsigned> counter = 0;
    while (true) {
      path = folder / fmt::format(".quorum-{}-{}.tmp", ::getpid(), counter++);
      const int value = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (value >= 0 || errno != EEXIST) return Descriptor(value);
    }
  }

  fs::path path_;
  Descriptor descriptor_;
  bool renamed_ = false;
};

/// False, with the reason in errno, if not all bytes could be written.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Makes a rename in a folder last through a power failure. Not every file system offers that, and the rename is done:
/// a failure is no reason to call the file unwritten.
void sync_folder(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

}  // namespace

Expected<std::string> read_file(const fs::path& path) try {
  // O_NONBLOCK: a pipe without a writer must be refused below, not waited for.
  const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status = {};
  if (descriptor.get() < 0 || ::fstat(descriptor.get(), &status) != 0) return system_failure(path, "read", errno);
  if (S_ISDIR(status.st_mode))
    return failure(ErrorKind::kInput, fmt::format("{}: is a folder, expected a file", path.string()));
  if (!S_ISREG(status.st_mode))
    return failure(ErrorKind::kInput, fmt::format("{}: is not a regular file; copy it to one", path.string()));
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = ::read(descriptor.get(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno != EINTR) return system_failure(path, "read", errno);
    if (count == 0) break;
    if (count > 0) filled += static_cast<std::size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::kMemory, fmt::format("{}: does not fit into memory", path.string()));
} catch (const std::length_error&) {
  return failure(ErrorKind::kMemory, fmt::format("{}: does not fit into memory", path.string()));
}

Expected<void> write_file(const fs::path& path, std::string_view bytes) {
  // Renaming onto a device or a pipe would replace it.
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: cannot write: is not a regular file; choose another output path", path.string()));

  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  TemporaryFile temporary(folder);
  if (temporary.descriptor() < 0 || !write_all(temporary.descriptor(), bytes) || ::fsync(temporary.descriptor()) != 0 ||
      !temporary.rename_to(path))
    return system_failure(path, "write", errno);
  sync_folder(folder);
  return {};
}

Expected<void> make_folder(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (code) return system_failure(path, "make the folder", code.value());
  const TemporaryFile probe(path);
  if (probe.descriptor() < 0) return system_failure(path, "write to the folder", errno);
  return {};
}

}  // namespace quorum
