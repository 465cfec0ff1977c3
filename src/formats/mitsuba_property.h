// The value elements of a Mitsuba scene file, <float> to <transform>, as properties of a node.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mitsuba_element.h"
#include "formats/mitsuba_parameters.h"
#include "formats/mitsuba_upgrade.h"
#include "formats/xml_document.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken {

/// What reading any element needs, and changes as it goes.
struct MitsubaContext {
  const FileSystem& files;
  Diagnostics& diagnostics;
  SceneParameters parameters;
  /// Of `Description`: as in Mitsuba 3, the last <path> comes first and the folder of the scene behind them.
  std::vector<std::string> search_paths;
  /// Where the file that is being read looks for includes, folders and spectra: its own <path>s and its own folder
  /// come before those of the file that includes it.
  std::vector<std::string> file_folders;
  MitsubaUpgrade upgrade;

  Element open(const XmlDocument& document, pugi::xml_node node, const AttributeRules& rules) {
    return open_element(document, node, rules, parameters, diagnostics);
  }
  /// Complains if there is anything inside the element.
  void refuse_contents(const XmlDocument& document, pugi::xml_node node) const;
  /// The file that is meant in the file that is being read; empty after a complaint. Warns of two of one name.
  std::string find_file(const Literal& name) const;
  /// Whether there are so many complaints that going on is of no use.
  bool gave_up() const { return diagnostics.error_count() >= 100; }
};

/// boolean, float, ...
const std::vector<std::string>& value_types();

/// Those of them that Mitsuba 0.x had besides: blackbody, srgb.
const std::vector<std::string>& old_value_types();

/// The attributes that a value element may have in a scene of that version.
AttributeRules value_rules(std::string_view type, SceneVersion version);

/// The property that `xml`, opened as `element`, gives; `name` is its name today. Empty after a complaint.
std::optional<Property> read_property(MitsubaContext& context, const XmlDocument& document, pugi::xml_node xml,
                                      const Element& element, const std::string& name);

}  // namespace norrsken
