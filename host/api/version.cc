#include "engine/core/version.h"

#include <quorum/quorum.h>

#include <cstdio>
#include <cstdlib>

namespace quorum::v0 {

std::string version() { return std::string(quorum::version()); }

void end_by_misuse(const std::string& what) {
  std::fprintf(stderr, "quorum: %s\n", what.c_str());
  std::abort();
}

}  // namespace quorum::v0
