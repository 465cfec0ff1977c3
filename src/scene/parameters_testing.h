// A node to ask parameters of, and what is said about it.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "scene/memory_files.h"
#include "scene/parameters.h"

namespace norrsken {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ParametersTest : public testing::Test {
 protected:
  ParametersTest() {
    node_.kind = "bsdf";
    node_.plugin = "diffuse";
    node_.location = {"room.xml", 1, 1, 5, "<bsdf ...>"};
  }

  template <typename Value>
  void give(std::string name, std::string type, Value value) {
    node_.properties.push_back(property(std::move(name), std::move(type), std::move(value)));
  }
  template <typename Value>
  static Property property(std::string name, std::string type, Value value) {
    Property property;
    property.location = {"dir/room.xml", 2, 3, 1, "  X"};
    property.name_location = {"dir/room.xml", 3, 3, 1, "  N"};
    property.name = std::move(name);
    property.type = std::move(type);
    if constexpr (std::is_same_v<Value, glm::dmat4>) {
      property.value = to_transform(value);
    } else {
      property.value = std::move(value);
    }
    return property;
  }
  void give_child(std::string kind, std::string plugin, std::string name = {}, std::vector<Property> properties = {}) {
    auto child = std::make_shared<Node>();
    child->properties = std::move(properties);
    child->location = {"dir/room.xml", 5, 3, 1, "  C"};
    child->kind = std::move(kind);
    child->plugin = std::move(plugin);
    node_.children.push_back({std::move(name), child, {"dir/room.xml", 4, 3, 1, "  C"}});
  }
  Parameters parameters() { return Parameters(node_, description_, files_, diagnostics_); }

  // The message and what is accepted of the only complaint, or all of them.
  std::string complaint() const {
    std::string text;
    for (const Diagnostic& d : diagnostics_.all()) {
      text += (text.empty() ? "" : "; ") + std::to_string(d.location.line) + ": " + d.message;
      if (!d.accepted.empty()) text += " (accepted: " + d.accepted + ")";
    }
    return text;
  }

  Node node_;
  Description description_;
  MemoryFiles files_;
  Diagnostics diagnostics_;
};

}  // namespace norrsken
