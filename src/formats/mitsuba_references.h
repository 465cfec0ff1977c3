// The `id`s of a scene file and the `ref`s to them, which may also point forward.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "norrsken/diagnostics.h"
#include "scene/description.h"

namespace norrsken {

class References {
 public:
  explicit References(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// Gives a node its id. A second node of that id is an error.
  void name(const std::string& id, std::shared_ptr<const Node> node, const SourceLocation& location);
  /// `alias` stands for `id` from now on, and before.
  void alias(const std::string& id, const std::string& alias, const SourceLocation& id_location,
             const SourceLocation& alias_location);
  /// Leaves room for a child of `parent` that is known by `id`.
  void refer(Node& parent, const std::string& id, std::string name, const SourceLocation& location);

  /// Puts the nodes in their places below `root`. Unknown ids are errors, and their places vanish. References in a
  /// circle or very deep ones are errors too; then no reference is kept at all and the result is false, so that whoever
  /// walks or destroys the nodes comes to an end.
  bool resolve(const Node& root);

 private:
  struct Target {
    std::shared_ptr<const Node> node;
    SourceLocation location;
  };
  struct Alias {
    std::string alias, id;
    SourceLocation location;  ///< of the id
  };
  /// A node on the way from the root, and which of its children the way goes on with.
  struct Step {
    const Node* node;
    std::size_t child;
    int height;  ///< of the children seen so far, plus one
  };
  struct Reference {
    Node* parent;
    std::size_t child;
    std::string id;
    SourceLocation location;
  };

  bool is_free(const std::string& id, const SourceLocation& location);
  std::shared_ptr<const Node> find(const std::string& id) const;
  std::vector<std::string> known() const;
  /// Complains about circles and depth.
  bool check_shape(const Node& root) const;
  SourceLocation last_reference(const std::vector<Step>& path) const;

  std::unordered_map<std::string, Target> targets_;
  std::unordered_map<std::string, std::size_t> alias_index_;
  std::vector<Alias> aliases_;
  std::vector<Reference> references_;
  Diagnostics& diagnostics_;
};

}  // namespace norrsken
