#include "engine/core/memory.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace quorum {
namespace {

/// The number in a file of one, such as those of a cgroup; fallback if there is none ("max").
std::uint64_t number_in(const char* path, std::uint64_t fallback) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? number : fallback;
}

/// MemAvailable of /proc/meminfo.
std::uint64_t available_on_machine() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    std::uint64_t kibibytes = 0;
    if (name == "MemAvailable:" && file >> kibibytes) return kibibytes * 1024;
  }
  return 0;
}

}  // namespace

namespace {

std::uint64_t peak_of(int whom) {
  rusage usage{};
  getrusage(whom, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

std::uint64_t peak_memory_bytes() { return peak_of(RUSAGE_SELF); }

std::uint64_t children_peak_memory_bytes() { return peak_of(RUSAGE_CHILDREN); }

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all_pages = 0;
  std::uint64_t resident_pages = 0;
  if (!(file >> all_pages >> resident_pages)) return 0;
  return resident_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t available_bytes() {
  constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t limit = number_in("/sys/fs/cgroup/memory.max", kNoLimit);
  const std::uint64_t used = number_in("/sys/fs/cgroup/memory.current", 0);
  const std::uint64_t in_group = limit > used ? limit - used : 0;
  return std::min(available_on_machine(), in_group);
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void return_large_blocks_at_once() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 512 << 10);  // also keeps glibc from raising it with the first large block that is freed
#endif
}

}  // namespace quorum
