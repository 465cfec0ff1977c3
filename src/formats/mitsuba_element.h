// An element of a Mitsuba scene file with its attributes checked and its `$parameters` filled in.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mitsuba_parameters.h"
#include "formats/xml_document.h"

namespace norrsken {

/// An attribute's value and where it stands.
struct Literal {
  std::string name;
  std::string text;  ///< with entities decoded and parameters filled in
  const XmlDocument* document = nullptr;
  XmlSpan span;          ///< of the value
  bool verbatim = true;  ///< whether `text` is what the file says, byte for byte
  std::string origin;    ///< where it is not: " (from '$fov')" or " (from '$fov', set by -Dfov=abc)"

  SourceLocation location() const { return document->location(span); }
  std::string_view raw() const { return document->source().text().substr(span.offset, span.length); }
  /// Of a piece of `text`; of all of it if the file says something else.
  SourceLocation location(std::size_t offset, std::size_t length) const;
  /// A piece of `text` in quotes, with its origin: 'abc' (from '$fov').
  std::string quote(std::string_view piece) const;
};

struct Element {
  std::string name;
  SourceLocation location;
  std::vector<Literal> attributes;
  bool good = true;  ///< false: there was a complaint about an attribute, or one is missing

  const Literal* find(std::string_view attribute) const;
  /// Its text; empty if there is none.
  std::string text(std::string_view attribute) const;
};

/// The attributes that an element may have. In groups of one, they are required unless marked optional.
struct AttributeRules {
  std::vector<std::string> required;
  std::vector<std::string> optional;
};

/// Complains about repeated and unknown attributes, missing ones, and undefined parameters in their values.
Element open_element(const XmlDocument& document, pugi::xml_node node, const AttributeRules& rules,
                     SceneParameters& parameters, Diagnostics& diagnostics);

}  // namespace norrsken
