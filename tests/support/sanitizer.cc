#include "tests/support/sanitizer.h"

namespace quorum {

bool freed_memory_is_kept() {
#ifdef __SANITIZE_ADDRESS__
  return true;
#else
  return false;
#endif
}

}  // namespace quorum
