// Reader for scenes in the language of pbrt-v4, and of what version 3 says in other words: docs/pbrt.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "norrsken/diagnostics.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken {

/// Whether a text begins as pbrt's files do: with one of its directives, behind blanks and comments.
bool looks_like_pbrt(std::string_view text);

/// Reads `path`, packed by gzip or not, with what it includes. Empty after an error.
std::optional<Description> read_pbrt(const std::string& path, const FileSystem& files, Diagnostics& diagnostics);

}  // namespace norrsken
