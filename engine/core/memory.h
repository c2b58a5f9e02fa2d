// The memory that this process holds, and that the machine has.
#pragma once

#include <cstdint>

namespace quorum {

/// Largest memory that this process has held so far, bytes.
std::uint64_t peak_memory_bytes();

/// The same of the largest of the programs that this process started and that have ended; 0 if there are none.
std::uint64_t children_peak_memory_bytes();

/// Memory that this process holds now, bytes; 0 if the system does not tell.
std::uint64_t resident_bytes();

/// Memory that could still be taken without swapping, bytes: of the machine and of the group of processes (cgroup) that
/// this one belongs to. 0 if the system does not tell.
std::uint64_t available_bytes();

/// Gives memory that was freed back to the system, as far as it can be.
void return_freed_memory();

/// From now on, large blocks go back to the system as soon as they are freed, which costs some time at each.
void return_large_blocks_at_once();

}  // namespace quorum
