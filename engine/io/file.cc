#include "engine/io/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "engine/io/temporary_file.h"

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

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

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

namespace {

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

/// Renaming onto a device or a pipe would replace it.
Expected<void> check_replaceable(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    return failure(ErrorKind::kInput,
                   fmt::format("{}: cannot write: is not a regular file; choose another output path", path.string()));
  return {};
}

}  // namespace

Expected<void> check_writable(const fs::path& path) {
  QUORUM_TRY(check_replaceable(path));
  const TemporaryFile probe(folder_of(path));
  if (probe.descriptor() < 0) return system_failure(path, "write", errno);
  return {};
}

Expected<void> write_file(const fs::path& path, std::string_view bytes) {
  QUORUM_TRY(check_replaceable(path));
  const fs::path folder = folder_of(path);
  TemporaryFile temporary(folder);
  if (temporary.descriptor() < 0 || !write_all(temporary.descriptor(), bytes) || ::fsync(temporary.descriptor()) != 0 ||
      !temporary.rename_to(path))
    return system_failure(path, "write", errno);
  sync_folder(folder);
  return {};
}

struct FileGroup::Member {
  std::unique_ptr<TemporaryFile> file;
  fs::path path;
};

FileGroup::FileGroup() = default;
FileGroup::~FileGroup() = default;

Expected<void> FileGroup::add(const fs::path& path, std::string_view bytes) {
  QUORUM_TRY(check_replaceable(path));
  auto file = std::make_unique<TemporaryFile>(folder_of(path));
  if (file->descriptor() < 0 || !write_all(file->descriptor(), bytes)) return system_failure(path, "write", errno);
  members_.push_back({std::move(file), path});
  return {};
}

Expected<void> FileGroup::finish() {
  if (members_.empty()) return {};
  // All that the file system has not written yet, which is little else, rather than a wait for each file.
  if (::syncfs(members_.front().file->descriptor()) != 0) return system_failure(members_.front().path, "write", errno);
  for (Member& member : members_)
    if (!member.file->rename_to(member.path)) return system_failure(member.path, "write", errno);
  sync_folder(folder_of(members_.front().path));
  members_.clear();
  return {};
}

void remove_file(const fs::path& path) {
  struct stat status = {};
  if (::lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::unlink(path.c_str()) == 0)
    sync_folder(folder_of(path));
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
