#include "shape/shape_file_host.h"

#include <fmt/core.h>

#include "base/text.h"

namespace norrsken {

std::optional<FileContents> read_shape_file(const std::string& path, std::string_view parameter, Parameters& p,
                                            Shapes& shapes) {
  std::string problem;
  std::optional<FileContents> contents = read_counted(shapes.files(), path, problem);
  if (!contents) {
    p.error(parameter, fmt::format("cannot read {}: {}", quoted(path, 200), problem),
            fmt::format("a readable {} file", p.node().plugin));
    return std::nullopt;
  }
  p.diagnostics().named_at(path, p.where(parameter));
  return contents;
}

}  // namespace norrsken
