#include "formats/reader_testing.h"

namespace norrsken {

// Tests know no built-in files.
std::vector<std::pair<std::string_view, std::string_view>> builtin_files() { return {}; }

std::optional<Description> read_scene(const TestFiles& files, const TestParameters& parameters,
                                      Diagnostics& diagnostics) {
  return read_mitsuba_xml("room.xml", MemoryFiles(files), parameters, diagnostics);
}

std::optional<Description> read_scene(const std::string& xml, const TestParameters& parameters,
                                      Diagnostics& diagnostics) {
  return read_scene(TestFiles{{"room.xml", xml}}, parameters, diagnostics);
}

std::string to_text(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.all()) text += (text.empty() ? "" : "\n") + to_text(diagnostic);
  return text;
}

std::string complaints_about(const TestFiles& files, const TestParameters& parameters) {
  Diagnostics diagnostics;
  read_scene(files, parameters, diagnostics);
  return to_text(diagnostics);
}

std::string complaints_about(const std::string& xml, const TestParameters& parameters) {
  return complaints_about(TestFiles{{"room.xml", xml}}, parameters);
}

}  // namespace norrsken
