// Scenes of Mitsuba 0.x in the words of Mitsuba 3: names of elements, plugins and parameters, and what has come to mean
// something else. Where Mitsuba 3 takes such a scene by itself, it means here what it means there; what that makes of
// it against Mitsuba 0.6 is told in a warning.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "formats/mitsuba_element.h"
#include "norrsken/diagnostics.h"
#include "scene/description.h"

namespace norrsken {

struct SceneVersion {
  int major = 3, minor = 0;

  /// Whether the file is upgraded at all: what came after 0.6 was 2.0.
  bool is_old() const { return major < 2; }
  /// Whether it is of a version before 0.`other_minor`.
  bool is_before(int other_minor) const { return major == 0 && minor < other_minor; }
};

class MitsubaUpgrade {
 public:
  explicit MitsubaUpgrade(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Of the file that is being read.
  SceneVersion version;

  /// The name that an element (`luminaire`, `lookAt`) has today; a change is noted.
  std::string element(const XmlDocument& document, pugi::xml_node element);
  /// The name that a parameter (`maxDepth`) has today; a change is noted.
  std::string parameter(const Literal& name);
  /// A node of the file that is being read, to be upgraded by `finish`.
  void add(std::shared_ptr<Node> node);
  /// Upgrades the nodes that were added, once they have all their properties and children.
  /// `scene` loses the textures that nothing needs any longer.
  void finish(Node& scene);

  /// File by file, in the order of lines; of very many the first, and how many more there are.
  std::vector<SceneChange> take_changes();

 private:
  void note(const SourceLocation& location, std::string text);
  /// Notes a change that the image shows, and warns of it.
  void warn(const SourceLocation& location, std::string text);

  void upgrade(Node& node, SceneVersion version);
  void upgrade_with_children(const Node* node);
  void rename_parameters(Node& node, SceneVersion version);
  void leave_out_parameters(Node& node);
  void rename_plugin(Node& node, SceneVersion version);
  void upgrade_bsdf(Node& node, SceneVersion version);
  void upgrade_microfacet(Node& node);
  void upgrade_conductor(Node& node);
  void upgrade_mixture(Node& node);
  void upgrade_texture(Node& node);
  void upgrade_bitmap(Node& node);
  void upgrade_scale_texture(Node& node);
  void upgrade_integrator(Node& node);
  void upgrade_multichannel(Node& node);
  void upgrade_film(Node& node, SceneVersion version);
  void upgrade_sensor(Node& node, SceneVersion version);
  void upgrade_emitter(Node& node);
  void upgrade_shape(Node& node, SceneVersion of);

  struct OldNode {
    std::shared_ptr<Node> node;
    SceneVersion version;
  };
  std::vector<const Node*> order_;                      ///< in which they were added
  std::unordered_map<const Node*, OldNode> old_nodes_;  ///< that are still to be upgraded
  std::unordered_set<const Node*> taken_apart_;         ///< whose contents have gone to whom they were for
  std::vector<SceneChange> changes_;
  std::uint64_t left_out_ = 0;  ///< changes, for there are so many
  bool told_of_white_ = false, told_of_materials_ = false;
  Diagnostics& diagnostics_;
};

}  // namespace norrsken
