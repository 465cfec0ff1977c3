// Reader for Mitsuba 3's XML scene format.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken {

/// Reads `path` with its includes. `parameters` are the -D values, which win over `<default>`; one that no `$name`
/// uses is an error. Knows the grammar and the value types, not the plugins: those are the compiler's.
std::optional<Description> read_mitsuba_xml(const std::string& path, const FileSystem& files,
                                            const std::vector<std::pair<std::string, std::string>>& parameters,
                                            Diagnostics& diagnostics);

}  // namespace norrsken
