#include "compile/compile.h"

#include "compile/builder.h"

namespace norrsken {

std::optional<LoadedScene> compile(const Description& description, const FileSystem& files, const LoadOptions& options,
                                   Diagnostics& diagnostics) {
  LoadedScene scene = Builder(description, files, diagnostics).build(options);
  if (diagnostics.has_errors()) return std::nullopt;
  return scene;
}

}  // namespace norrsken
