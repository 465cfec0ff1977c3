// What the tests of the scene reader share: reading a scene from memory, and its complaints as one text.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/mitsuba_xml.h"
#include "scene/memory_files.h"

namespace norrsken {

using TestFiles = std::map<std::string, std::string>;
using TestParameters = std::vector<std::pair<std::string, std::string>>;

/// Reads "room.xml" of `files`.
std::optional<Description> read_scene(const TestFiles& files, const TestParameters& parameters,
                                      Diagnostics& diagnostics);
std::optional<Description> read_scene(const std::string& xml, const TestParameters& parameters,
                                      Diagnostics& diagnostics);

/// Kinds, plugins, values and children, without places and ids: scenes that mean the same have the same text.
std::string text_of(const Node& node);

/// All complaints, as a person reads them, one after the other.
std::string complaints_about(const TestFiles& files, const TestParameters& parameters = {});
std::string complaints_about(const std::string& xml, const TestParameters& parameters = {});
std::string to_text(const Diagnostics& diagnostics);

}  // namespace norrsken
