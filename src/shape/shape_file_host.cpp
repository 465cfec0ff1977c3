#include "shape/shape_file_host.h"

#include <fmt/format.h>

#include "base/text.h"

namespace norrsken {

std::optional<std::string> read_shape_file(const std::string& path, Parameters& p, Builder& builder) {
  std::string problem;
  std::optional<std::string> bytes = builder.files().read(path, problem);
  if (!bytes) {
    p.error("filename", fmt::format("cannot read {}: {}", quoted(path, 200), problem),
            fmt::format("a readable {} file", p.node().plugin));
    return std::nullopt;
  }
  builder.diagnostics().named_at(path, p.where("filename"));
  return bytes;
}

}  // namespace norrsken
