// Reader for Mitsuba's XML scene format.
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
///
/// Empty if a part of the scene is not known at all (no file, no XML, a missing include). Otherwise what could be read,
/// even after complaints, so that the compiler can add its own: ask `diagnostics.has_errors()`.
///
/// `preferred` are values for parameters that the scene has a `<default>` for and `parameters` do not set.
///
/// Versions before 2.0 are upgraded (see formats/mitsuba_upgrade.h).
///
/// Departures from Mitsuba 3: `$name` is the longest run of letters, digits and _; `look_at` is also `lookat`; rgb takes
/// #rrggbb (sRGB); binary spectra (.spb) and <animation> are not supported.
std::optional<Description> read_mitsuba_xml(const std::string& path, const FileSystem& files,
                                            const std::vector<std::pair<std::string, std::string>>& parameters,
                                            Diagnostics& diagnostics,
                                            const std::vector<std::pair<std::string, std::string>>& preferred = {});

}  // namespace norrsken
