// Loading that may run out of memory.
#pragma once

#include <functional>
#include <string>

#include "norrsken/diagnostics.h"

namespace norrsken {

/// Memory has run out, which was complained about: the rest of the scene is not looked at.
struct LoadingStopped {};

/// What to do about what does not fit into the memory that is left.
std::string accepted_memory(std::uint64_t left);

/// Calls `load`. If the budget or the system has no more memory for it, complains at `place` that `what` does not fit,
/// and throws LoadingStopped.
void within_memory(const SourceLocation& place, const std::string& what, Diagnostics& diagnostics,
                   const std::function<void()>& load);

}  // namespace norrsken
