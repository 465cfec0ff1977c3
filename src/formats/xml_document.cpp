#include "formats/xml_document.h"

#include <fmt/format.h>

#include <utility>

#include "base/text.h"
#include "formats/xml_encoding.h"

namespace norrsken {
namespace {

// Complains if the text is none that an XML parser may see.
bool check_text(const SourceText& source, Diagnostics& diagnostics) {
  const std::string_view text = source.text();
  if (const std::size_t null = text.find('\0'); null != std::string_view::npos) {
    diagnostics.error(source.location(null), "the file contains a NUL byte", "text");
    return false;
  }
  if (trim(text).empty()) {
    diagnostics.error(source.location(), "the file is empty", "<scene version=\"3.0.0\"> ... </scene>");
    return false;
  }
  return true;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

XmlDocument::XmlDocument(const std::string& path, std::string contents)
    : contents_(std::move(contents)), source_(path, contents_) {}

std::unique_ptr<XmlDocument> XmlDocument::parse(const std::string& path, std::string contents,
                                                Diagnostics& diagnostics) {
  if (!decode_xml(contents, path, diagnostics)) return nullptr;
  std::unique_ptr<XmlDocument> document(new XmlDocument(path, std::move(contents)));
  const bool good =
      check_text(document->source_, diagnostics) && document->load(diagnostics) && document->find_root(diagnostics);
  return good ? std::move(document) : nullptr;
}

bool XmlDocument::load(Diagnostics& diagnostics) {
  const std::string_view text = source_.text();
  // As a fragment, so that text beside the root is seen and refused instead of being skipped.
  const auto result =
      document_.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_fragment, pugi::encoding_utf8);
  if (result) return true;
  if (!explain_malformed_xml(source_, diagnostics))
    diagnostics.error(source_.location(static_cast<std::size_t>(result.offset)),
                      fmt::format("this is not XML: {}", result.description()));
  return false;
}

bool XmlDocument::find_root(Diagnostics& diagnostics) {
  for (const pugi::xml_node node : document_.children()) {
    if (node.type() == pugi::node_element && !root_) {
      root_ = node;
    } else {
      const bool element = node.type() == pugi::node_element;
      diagnostics.error(location(node), element ? "a second element at the top" : "text outside of the root element",
                        "one element with everything else inside");
      return false;
    }
  }
  if (!root_)
    diagnostics.error(source_.location(), "the file has no elements", "<scene version=\"3.0.0\"> ... </scene>");
  return !root_.empty();
}

SourceLocation XmlDocument::location(pugi::xml_node node) const {
  const std::ptrdiff_t offset = node.offset_debug();
  if (offset < 0) return source_.location();
  auto at = static_cast<std::size_t>(offset);
  if (node.type() == pugi::node_element) return source_.location(at - 1, 1 + std::string_view(node.name()).size());
  const std::string_view text = source_.text();
  while (at < text.size() && is_blank(text[at])) ++at;
  const std::string_view rest = text.substr(at);
  return source_.location(at, trim(rest.substr(0, rest.find('<'))).size());
}

std::vector<XmlAttribute> XmlDocument::attributes(pugi::xml_node element) const {
  const std::string_view text = source_.text();
  std::size_t at = static_cast<std::size_t>(element.offset_debug()) + std::string_view(element.name()).size();
  std::vector<XmlAttribute> result;
  // The parser has accepted the tag: NAME = "VALUE" with blanks anywhere, as often as it says.
  for (const pugi::xml_attribute attribute : element.attributes()) {
    while (is_blank(text[at])) ++at;
    XmlAttribute entry{attribute.name(), attribute.value(), {}, {}};
    entry.name_span = {at, entry.name.size()};
    const std::size_t opening = text.find_first_of("\"'", at + entry.name.size());
    const std::size_t closing = text.find(text[opening], opening + 1);
    entry.value_span = {opening + 1, closing - opening - 1};
    at = closing + 1;
    result.push_back(entry);
  }
  return result;
}

}  // namespace norrsken
