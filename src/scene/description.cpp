#include "scene/description.h"

#include "base/text.h"

namespace norrsken {

std::string name_of(const Node& node) {
  return node.plugin.empty() ? node.kind : node.kind + " " + quoted(node.plugin);
}

}  // namespace norrsken
