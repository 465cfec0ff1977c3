// What the fuzz targets of whole scenes share.
#pragma once

#include <memory>

#include "compile/compile.h"
#include "fuzz/fuzz.h"
#include "scene/memory_files.h"

namespace norrsken::fuzz {

/// `read` makes a description of a scene in `files`, or complains; what it makes is compiled, up to the tables that are
/// rendered. Of a scene that asks for more than a budget, that is what is told.
template <class Read>
void check_scene(const MemoryFiles& files, const Read& read) {
  const MemoryScope scope(std::make_shared<MemoryBudget>(std::uint64_t{256} << 20));
  Diagnostics diagnostics;
  try {
    const auto description = read(diagnostics);
    require(description.has_value() != diagnostics.has_errors(), "a description or errors");
    if (!description) return;
    const auto scene = compile(*description, files, {}, diagnostics);
    diagnostics.sort();
    check_complaints(scene.has_value(), diagnostics);
  } catch (const MemoryExceeded&) {
    // Its reader's caller tells of it.
  }
}

}  // namespace norrsken::fuzz
