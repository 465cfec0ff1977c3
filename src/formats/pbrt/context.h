// What all parts of the reader of pbrt scenes share.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "formats/pbrt/color.h"
#include "formats/pbrt/parameters.h"
#include "scene/description.h"
#include "scene/file_system.h"

namespace norrsken::pbrt {

class Context {
 public:
  /// `folder` is that of the scene's own file, which all names are relative to.
  Context(const FileSystem& all_files, Diagnostics& complaints, std::string folder)
      : files(all_files), diagnostics(complaints), folders{std::move(folder)} {}

  const FileSystem& files;
  Diagnostics& diagnostics;
  std::vector<std::string> folders;
  MemoryReservation memory{0};  ///< of nodes, and of what the description holds in ordinary arrays
  /// The film's response: what pbrt multiplies every sample with. Lights are brighter by it here.
  double imaging_ratio = 1;

  /// What is another picture than pbrt's, and what there is instead: told once.
  void tell(const Place& place, const std::string& message, const std::string& instead = {}) {
    if (!told_.insert(message).second) return;
    diagnostics.warning(place.location(), instead.empty() ? message : message + "; instead: " + instead);
  }
  /// The path of the file that a parameter names; empty after a complaint.
  std::string find_file(const Parameter& parameter) const;
  std::string find_file(const Parameter& parameter, const std::string& name) const;

 private:
  std::set<std::string> told_;
};

/// Sets a value together with the place that it is from, for complaints of those who compile it.
void give(Node& node, std::string name, Property::Value value, const Place& place);
Node make_node(std::string kind, std::string plugin, const Place& place);
void add_child(Node& parent, std::shared_ptr<const Node> child, std::string as, const Place& place);

inline Property::Rgb to_rgb(const glm::dvec3& color) { return {{color.r, color.g, color.b}}; }

}  // namespace norrsken::pbrt
