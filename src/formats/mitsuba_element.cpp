#include "formats/mitsuba_element.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"

namespace norrsken {

SourceLocation Literal::location(std::size_t offset, std::size_t length) const {
  return verbatim ? document->location({span.offset + offset, length}) : location();
}

std::string Literal::quote(std::string_view piece) const { return quoted(piece) + origin; }

const Literal* Element::find(std::string_view attribute) const {
  const auto named = [attribute](const Literal& literal) { return literal.name == attribute; };
  const auto found = std::find_if(attributes.begin(), attributes.end(), named);
  return found == attributes.end() ? nullptr : &*found;
}

std::string Element::text(std::string_view attribute) const {
  const Literal* literal = find(attribute);
  return literal ? literal->text : std::string();
}

Element open_element(const XmlDocument& document, pugi::xml_node node, const AttributeRules& rules,
                     SceneParameters& parameters, Diagnostics& diagnostics) {
  Element element{node.name(), document.location(node), {}, true};
  std::vector<std::string> known = rules.required;
  known.insert(known.end(), rules.optional.begin(), rules.optional.end());
  const std::string accepted = known.empty() ? "no attributes" : join(known);

  bool has_unknown = false;
  for (const XmlAttribute& attribute : document.attributes(node)) {
    if (std::find(known.begin(), known.end(), attribute.name) == known.end()) {
      has_unknown = true;
      diagnostics.error(document.location(attribute.name_span),
                        fmt::format("<{}> has no attribute {}{}", element.name, quoted(attribute.name),
                                    did_you_mean(attribute.name, known)),
                        accepted);
      continue;
    }
    if (element.find(attribute.name)) {
      element.good = false;
      diagnostics.error(document.location(attribute.name_span),
                        fmt::format("attribute '{}' is given twice", attribute.name), "each attribute once");
      continue;
    }
    Literal literal{
        std::string(attribute.name), std::string(attribute.value), &document, attribute.value_span, true, {}};
    if (!parameters.fill_in(literal.text, literal.location())) element.good = false;
    const std::string_view raw = literal.raw();
    literal.verbatim = literal.text == raw;
    if (!literal.verbatim) {
      const std::string set_by = parameters.set_by(raw);
      literal.origin = fmt::format(" (from {}{}{})", quoted(raw), set_by.empty() ? "" : ", set by ", shortened(set_by));
    }
    element.attributes.push_back(std::move(literal));
  }
  // An unknown attribute is most likely the missing one, misspelt: one complaint is enough.
  for (const std::string& required : rules.required) {
    if (has_unknown || element.find(required)) continue;
    element.good = false;
    diagnostics.error(element.location, fmt::format("<{}> needs an attribute '{}'", element.name, required), accepted);
  }
  if (has_unknown) element.good = false;
  return element;
}

}  // namespace norrsken
