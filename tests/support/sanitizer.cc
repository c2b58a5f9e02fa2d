#include "tests/support/sanitizer.h"

namespace quorum {

bool freed_memory_is_kept() {
#if defined(__SANITIZE_ADDRESS__) || (defined(__has_feature) && __has_feature(address_sanitizer))
  return true;
#else
  return false;
#endif
}

}  // namespace quorum
