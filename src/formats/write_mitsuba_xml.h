// Writes a description as a scene of Mitsuba 3.
#pragma once

#include <string>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken {

/// `path` in XML, and in the folder "NAME_files" beside it meshes as PLY, images of the description as EXR, and copies of the
/// files that it names. Returns what was written, empty after complaints. What Mitsuba has no plugin for is warned of, once
/// for each name, with what is written in its place.
std::vector<std::string> write_mitsuba_xml(const Description& description, const std::string& path,
                                           const FileSystem& files, Diagnostics& diagnostics);

/// The material nearest to a `gltf` one among Mitsuba's: `principled` or `principledthin`.
Node without_gltf(const Node& bsdf, Diagnostics& diagnostics);

}  // namespace norrsken
