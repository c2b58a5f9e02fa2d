// What a test must know of the build that it runs in.
#pragma once

namespace quorum {

/// True if the address sanitizer keeps freed memory, so that what a process holds says little.
#ifdef __SANITIZE_ADDRESS__
constexpr bool kFreedMemoryIsKept = true;
#else
constexpr bool kFreedMemoryIsKept = false;
#endif

}  // namespace quorum
