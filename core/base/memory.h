#pragma once

#include <cstdint>

/// What this process holds and what the machine has left, in bytes. Linux; 0 where the system does not tell.
namespace fluxwalk::base {

/// Resident now.
std::uint64_t residentMemory();
/// The most that was resident at once since the program started.
std::uint64_t peakMemory();
/// What the process could still take before the machine or its control group has no more, without swap.
std::uint64_t availableMemory();

}  // namespace fluxwalk::base
