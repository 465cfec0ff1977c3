// Files that shapes name.
#pragma once

#include <optional>

#include "compile/builder.h"

namespace norrsken {

/// The bytes of the file at `path`, which the parameter `filename` gave; a complaint if it cannot be read.
std::optional<FileContents> read_shape_file(const std::string& path, Parameters& p, Builder& builder);

}  // namespace norrsken
