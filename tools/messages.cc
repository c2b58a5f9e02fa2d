#include "tools/messages.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "engine/core/printable.h"

namespace quorum {
namespace {

int messages = STDERR_FILENO;
int lost_results = 0;  // errno of the first write to standard output that failed

}  // namespace

void open_messages() {
  // A file that takes the number of a closed standard error would get what libraries print there. Only for reading, so
  // that results for a closed standard output fail.
  while (true) {
    const int descriptor = ::open("/dev/null", O_RDONLY);
    if (descriptor > STDERR_FILENO) ::close(descriptor);
    if (descriptor < 0 || descriptor > STDERR_FILENO) break;
  }
  const int copy = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (copy >= 0) messages = copy;
}

void write_message(std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(messages, text.data(), text.size());
    if (written < 0 && errno != EINTR) return;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void tell(std::string_view line) { write_message(printable(line) + "\n"); }

void write_result(std::string_view text) noexcept {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() && lost_results == 0) lost_results = errno;
}

Expected<void> flush_results() {
  if (std::fflush(stdout) != 0 && lost_results == 0) lost_results = errno;
  if (lost_results == 0) return {};
  return failure(ErrorKind::kInput, fmt::format("standard output: cannot write: {}; give it another place",
                                                std::generic_category().message(lost_results)));
}

}  // namespace quorum
