// How much there is of what runs out first.
#pragma once

#include <cstdint>

namespace norrsken {

/// Bytes of memory that this machine has; the largest number if it does not say.
std::uint64_t physical_memory();

}  // namespace norrsken
