#include "engine/io/scratch_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace quorum {
namespace {

std::unexpected<Error> broken(const std::filesystem::path& folder, const char* what, int code) {
  return failure(ErrorKind::kInput, fmt::format("{}: cannot {} a file between two steps ({}); check the disk",
                                                folder.string(), what, std::strerror(code)));
}

/// Moves all bytes by move(bytes, offset), which may move fewer at a time and gives how many. The error code; 0 if all
/// were moved.
template <typename Bytes, typename Move>
int move_all(Bytes bytes, std::uint64_t offset, const Move& move) {
  while (!bytes.empty()) {
    const ssize_t count = move(bytes, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return EIO;  // the file ends before
    bytes = Bytes(bytes.data() + count, bytes.size() - static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
  return 0;
}

}  // namespace

ScratchFile::ScratchFile(ScratchFile&& other) noexcept
    : folder_(std::move(other.folder_)), file_(std::exchange(other.file_, -1)) {}

ScratchFile& ScratchFile::operator=(ScratchFile&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(file_, other.file_);
  return *this;
}

ScratchFile::~ScratchFile() {
  if (file_ >= 0) ::close(file_);
}

Expected<ScratchFile> ScratchFile::create(const std::filesystem::path& folder) {
  // As the temporary names of write_file, which the next run removes, if this one is killed before the name is gone.
  std::string name = (folder / ".quorum-XXXXXX.tmp").string();
  ScratchFile scratch;
  scratch.folder_ = folder;
  scratch.file_ = ::mkostemps(name.data(), 4, O_CLOEXEC);
  if (scratch.file_ < 0) return broken(folder, "make", errno);
  ::unlink(name.c_str());
  return scratch;
}

Expected<void> ScratchFile::write(std::uint64_t offset, std::string_view bytes) const {
  const int code = move_all(
      bytes, offset, [this](std::string_view part, off_t at) { return ::pwrite(file_, part.data(), part.size(), at); });
  if (code != 0) return broken(folder_, "write", code);
  return {};
}

Expected<void> ScratchFile::read(std::uint64_t offset, std::span<char> bytes) const {
  const int code = move_all(
      bytes, offset, [this](std::span<char> part, off_t at) { return ::pread(file_, part.data(), part.size(), at); });
  if (code != 0) return broken(folder_, "read", code);
  return {};
}

}  // namespace quorum
