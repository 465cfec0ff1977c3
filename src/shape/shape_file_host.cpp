#include "shape/shape_file_host.h"

#include <fmt/format.h>

#include "base/text.h"

namespace norrsken {

std::optional<FileContents> read_shape_file(const std::string& path, Parameters& p, Builder& builder) {
  std::string problem;
  std::optional<FileContents> contents = read_counted(builder.files(), path, problem);
  if (!contents) {
    p.error("filename", fmt::format("cannot read {}: {}", quoted(path, 200), problem),
            fmt::format("a readable {} file", p.node().plugin));
    return std::nullopt;
  }
  builder.diagnostics().named_at(path, p.where("filename"));
  return contents;
}

}  // namespace norrsken
