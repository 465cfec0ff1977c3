// Files by the names that scenes give them, which were often written on another machine.
#pragma once

#include <string>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/file_system.h"

namespace norrsken {

/// The path of the file or folder `name` in the first of `folders` that has it. With backslashes in a name that is nowhere
/// it is looked for with slashes, and a note says so. A warning tells of another one in a later folder. Empty after a
/// complaint, which names what is there under nearly that name. `origin` is as in Property.
std::string find_file(const FileSystem& files, const std::string& name, const std::vector<std::string>& folders,
                      const SourceLocation& named_at, const std::string& origin, Diagnostics& diagnostics);

}  // namespace norrsken
