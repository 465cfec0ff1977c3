// The formats that scenes are read from, one line each in scene_formats.cpp. All readers produce the same description.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken {

/// What is said over a scene as it is read.
struct SceneArguments {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< an error if the scene does not use one
  std::vector<std::pair<std::string, std::string>> preferred;   ///< for parameters that the scene has a default for
};

struct SceneReader {
  std::string_view name;                   ///< "Mitsuba XML"
  std::vector<std::string_view> suffixes;  ///< ".xml", in small letters
  bool (*sniff)(std::string_view bytes);   ///< whether a file that begins so is of the format
  /// Empty after complaints that leave no scene; see read_mitsuba_xml.
  std::optional<Description> (*read)(const std::string& path, const FileSystem& files, const SceneArguments& arguments,
                                     Diagnostics& diagnostics);
};

std::span<const SceneReader> scene_readers();

/// By the file's name, or where that does not tell by its first bytes. What nobody knows is left to the first reader, whose
/// complaint says what it may be.
const SceneReader& reader_of(const std::string& path, const FileSystem& files);

}  // namespace norrsken
