// How much memory there is to be had.
#pragma once

#include <cstdint>
#include <string>

namespace norrsken {

/// Bytes that processes can still take without swapping: the machine's available memory, or less where a control group
/// (version 1 or 2) has less left. File cache that a group would drop counts as left. kUnlimited if nothing says.
/// `root` stands for the root folder.
std::uint64_t available_memory(const std::string& root = "/");

/// Bytes of address space that this process may still take (RLIMIT_AS); kUnlimited without a limit.
std::uint64_t available_address_space();

/// Bytes of memory that this process holds.
std::uint64_t resident_memory();

}  // namespace norrsken
