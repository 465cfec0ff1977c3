// An XML file whose elements and attribute values know where they stand. pugixml parses; the places come from the text.
#pragma once

#include <cstddef>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/source_text.h"

namespace norrsken {

/// A stretch of bytes of the file, as UTF-8.
struct XmlSpan {
  std::size_t offset = 0, length = 0;
};

struct XmlAttribute {
  std::string_view name;
  std::string_view value;         ///< with entities decoded
  XmlSpan name_span, value_span;  ///< the value's without its quotes
};

/// Elements, attributes and text; comments, processing instructions and document types are skipped. No entity but the
/// five of XML and character numbers is expanded, nothing is fetched, and depth costs no stack.
class XmlDocument {
 public:
  /// Empty, with a complaint, if `contents` is empty, of an unknown encoding (see `decode_xml`) or not well-formed.
  static std::unique_ptr<XmlDocument> parse(const std::string& path, std::string contents, Diagnostics& diagnostics);

  /// The only element at the top.
  pugi::xml_node root() const { return root_; }
  const SourceText& source() const { return source_; }

  SourceLocation location(XmlSpan span) const { return source_.location(span.offset, span.length); }
  /// `<name` of an element, or the beginning of a text.
  SourceLocation location(pugi::xml_node node) const;
  /// In order of appearance; a repeated one appears repeatedly.
  std::vector<XmlAttribute> attributes(pugi::xml_node element) const;

 private:
  XmlDocument(const std::string& path, std::string contents);
  bool load(Diagnostics& diagnostics);
  bool find_root(Diagnostics& diagnostics);

  std::string contents_;
  SourceText source_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

/// Looks for what keeps `source` from being well-formed XML, and complains about the first such place. False if it
/// finds nothing.
bool explain_malformed_xml(const SourceText& source, Diagnostics& diagnostics);

}  // namespace norrsken
