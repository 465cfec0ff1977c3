#include "compile/compile.h"

#include "compile/builder.h"

namespace norrsken {

std::optional<LoadedScene> compile(const Description& description, const FileSystem& files, const LoadOptions& options,
                                   Diagnostics& diagnostics) {
  const int errors_before = diagnostics.error_count();
  LoadedScene scene = Builder(description, files, diagnostics).build(options);
  if (diagnostics.error_count() != errors_before) return std::nullopt;
  return scene;
}

}  // namespace norrsken
