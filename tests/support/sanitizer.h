// What a test must know of the build that it runs in.
#pragma once

namespace quorum {

/// True if the address sanitizer keeps freed memory, so that what a process holds says little.
bool freed_memory_is_kept();

}  // namespace quorum
