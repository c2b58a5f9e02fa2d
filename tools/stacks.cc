#include "tools/stacks.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>

namespace quorum {

Expected<void> allow_stacks() {
  constexpr rlim_t kWanted = rlim_t{8} << 20;
  constexpr rlim_t kLeast = rlim_t{512} << 10;
  rlimit limit = {};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kWanted) return {};
  const rlim_t before = limit.rlim_cur;
  // Who may raise the hard limit, too, may do so here.
  const rlimit raised = {kWanted, std::max(limit.rlim_max, kWanted)};
  if (::setrlimit(RLIMIT_STACK, &raised) != 0) {
    limit.rlim_cur = std::min(limit.rlim_max, kWanted);
    ::setrlimit(RLIMIT_STACK, &limit);
  }
  ::getrlimit(RLIMIT_STACK, &limit);
  if (limit.rlim_cur < kLeast)
    return failure(ErrorKind::kMemory, fmt::format("a stack may have {} KiB here, expected {} or more; raise the limit "
                                                   "(ulimit -s)",
                                                   before >> 10, kLeast >> 10));
  // Threads take the limit that the process began with.
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return {};
  ::pthread_attr_setstacksize(&attributes, limit.rlim_cur);
  ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
  return {};
}

}  // namespace quorum
