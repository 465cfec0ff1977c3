// The encodings that XML files are found in, as UTF-8.
#pragma once

#include <string>

#include "norrsken/diagnostics.h"

namespace norrsken {

/// Turns the bytes of an XML file into UTF-8: UTF-16 of either byte order, told by its mark or by its first character,
/// and what the declaration names of ISO-8859-1 and windows-1252; a byte order mark is taken away. All others must be
/// UTF-8 already; where they declare nothing else, bytes that are not are taken for windows-1252, with a warning. False
/// after a complaint about the file at `path`.
bool decode_xml(std::string& contents, const std::string& path, Diagnostics& diagnostics);

}  // namespace norrsken
