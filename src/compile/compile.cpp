#include "compile/compile.h"

#include "compile/builder.h"
#include "scene/within_memory.h"

namespace norrsken {

std::optional<LoadedScene> compile(const Description& description, const FileSystem& files, const LoadOptions& options,
                                   Diagnostics& diagnostics) {
  const MemoryScope scope(options.memory ? options.memory : MemoryBudget::of_machine());
  LoadedScene scene;
  try {
    within_memory(description.scene->location, "the scene", diagnostics,
                  [&] { scene = Builder(description, files, diagnostics).build(options); });
  } catch (const LoadingStopped&) {
    return std::nullopt;
  }
  if (diagnostics.has_errors()) return std::nullopt;
  return scene;
}

}  // namespace norrsken
