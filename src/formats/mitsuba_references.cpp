#include "formats/mitsuba_references.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_set>
#include <utility>

#include "base/text.h"

namespace norrsken {
namespace {

// Levels from a node down to its deepest descendant, references included: what recursive walks may rely on.
constexpr int kMaxHeight = 200;
// How often an alias may stand for another one.
constexpr int kMaxAliases = 16;

void drop_empty_children(Node& node) {
  std::erase_if(node.children, [](const Node::Child& child) { return child.node == nullptr; });
}

}  // namespace

bool References::is_free(const std::string& id, const SourceLocation& location) {
  const auto target = targets_.find(id);
  const auto alias = alias_index_.find(id);
  if (target == targets_.end() && alias == alias_index_.end()) return true;
  const SourceLocation& first = target != targets_.end() ? target->second.location : aliases_[alias->second].location;
  diagnostics_.error(location, fmt::format("the id {} is already used at {}:{}", quoted(id), first.file, first.line),
                     "an id of its own");
  return false;
}

void References::name(const std::string& id, std::shared_ptr<const Node> node, const SourceLocation& location) {
  if (is_free(id, location)) targets_.emplace(id, Target{std::move(node), location});
}

void References::alias(const std::string& id, const std::string& alias, const SourceLocation& id_location,
                       const SourceLocation& alias_location) {
  if (!is_free(alias, alias_location)) return;
  alias_index_.emplace(alias, aliases_.size());
  aliases_.push_back({alias, id, id_location});
}

void References::refer(Node& parent, const std::string& id, std::string name, const SourceLocation& location) {
  references_.push_back({&parent, parent.children.size(), id, location});
  parent.children.push_back({std::move(name), nullptr, location});
}

std::shared_ptr<const Node> References::find(const std::string& id) const {
  const std::string* current = &id;
  for (int steps = 0; steps <= kMaxAliases; ++steps) {
    if (const auto target = targets_.find(*current); target != targets_.end()) return target->second.node;
    const auto alias = alias_index_.find(*current);
    if (alias == alias_index_.end()) break;
    current = &aliases_[alias->second].id;
  }
  return nullptr;
}

std::vector<std::string> References::known() const {
  std::vector<std::string> ids;
  for (const auto& [id, target] : targets_) ids.push_back(id);
  for (const Alias& alias : aliases_) {
    if (find(alias.alias)) ids.push_back(alias.alias);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

bool References::resolve(const Node& root) {
  const std::vector<std::string> ids = known();
  const std::string accepted = ids.empty() ? "an id of the scene, which has none" : listed(ids);

  std::unordered_set<std::string> complained;
  const auto complain = [&](const std::string& id, const SourceLocation& location) {
    // Once an id: the suggestion costs a comparison with every other one.
    if (complained.insert(id).second && complained.size() <= 100)
      diagnostics_.error(location, fmt::format("nothing has the id {}{}", quoted(id), did_you_mean(id, ids)), accepted);
  };
  for (const Alias& alias : aliases_) {
    if (!find(alias.id)) complain(alias.id, alias.location);
  }
  for (const Reference& reference : references_) {
    Node::Child& child = reference.parent->children[reference.child];
    child.node = find(reference.id);
    if (!child.node) complain(reference.id, reference.location);
  }
  const bool good = check_shape(root);
  std::unordered_set<Node*> parents;
  for (const Reference& reference : references_) {
    if (!good) reference.parent->children[reference.child].node = nullptr;
    parents.insert(reference.parent);
  }
  for (Node* parent : parents) drop_empty_children(*parent);
  return good;
}

// A depth-first walk with a stack of its own, so that depth costs no stack here. A way that comes back to a node that
// it went through is a circle.
bool References::check_shape(const Node& root) const {
  constexpr int kOnTheWay = -1;
  std::unordered_map<const Node*, int> heights{{&root, kOnTheWay}};
  std::vector<Step> path{{&root, 0, 0}};
  while (!path.empty()) {
    Step& step = path.back();
    if (step.child == step.node->children.size()) {
      heights[step.node] = step.height;
      path.pop_back();
      continue;  // to the parent, which meets this node again and finds its height
    }
    const Node::Child& child = step.node->children[step.child];
    const auto height = child.node ? heights.find(child.node.get()) : heights.end();
    if (child.node && height == heights.end()) {
      heights.emplace(child.node.get(), kOnTheWay);
      path.push_back({child.node.get(), 0, 0});
      continue;
    }
    if (child.node && height->second == kOnTheWay) {
      const auto is_child = [&child](const Step& other) { return other.node == child.node.get(); };
      const std::vector<Step> circle(std::find_if(path.begin(), path.end(), is_child), path.end());
      diagnostics_.error(last_reference(circle), "this reference leads back to itself", "references without circles");
      return false;
    } else if (child.node && height->second >= kMaxHeight) {
      diagnostics_.error(child.location, fmt::format("references lead more than {} levels deep", kMaxHeight),
                         fmt::format("up to {} levels", kMaxHeight));
      return false;
    } else if (child.node) {
      step.height = std::max(step.height, height->second + 1);
    }
    ++step.child;
  }
  return true;
}

// Elements alone make no circle: there is a reference in it.
SourceLocation References::last_reference(const std::vector<Step>& path) const {
  std::set<std::pair<const Node*, std::size_t>> edges;
  for (const Reference& reference : references_) edges.emplace(reference.parent, reference.child);
  for (auto step = path.rbegin(); step != path.rend(); ++step) {
    if (edges.contains({step->node, step->child})) return step->node->children[step->child].location;
  }
  return {};
}

}  // namespace norrsken
