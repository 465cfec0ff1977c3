// Files that shapes name.
#pragma once

#include <optional>

#include "compile/shapes.h"
#include "scene/file_system.h"

namespace norrsken {

/// The bytes of the file at `path`, which that parameter gave; a complaint if it cannot be read.
std::optional<FileContents> read_shape_file(const std::string& path, std::string_view parameter, Parameters& p,
                                            Shapes& shapes);

}  // namespace norrsken
