// The scene as the file told it: typed nodes that know where they stood. No meaning yet: plugins give it.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/memory.h"
#include "norrsken/diagnostics.h"

namespace norrsken {

/// Coordinates and matrix elements beyond this are refused: their squares must fit a float.
inline constexpr double kMaxCoordinate = 1e12;

/// A value with a name inside a node: `<float name="fov" value="45"/>`.
struct Property {
  struct Rgb {
    glm::dvec3 value;  ///< linear sRGB
  };
  struct Spectrum {
    std::vector<std::pair<double, double>>
        samples;  ///< (wavelength in nm, value), ascending; one pair (0, v): constant
  };
  struct Vector {
    glm::dvec3 value;  ///< `point` and `vector`
  };
  /// Column-vector convention: world = matrix * local.
  using Transform = glm::dmat4;

  std::string name;
  std::variant<bool, std::int64_t, double, std::string, Rgb, Spectrum, Vector, Transform> value;
  std::string type;              ///< the word the file used: "float", "rgb", ...
  std::string origin;            ///< for a complaint, where it is of `$parameters`: " (from '$fov', set by -Dfov=0)"
  SourceLocation location;       ///< of the value
  SourceLocation name_location;  ///< of the name
  std::string written = {};      ///< the name that the file has, where it is an older one

  const std::string& file_name() const { return written.empty() ? name : written; }
};

/// A plugin instance: `<bsdf type="diffuse" id="white"> ... </bsdf>`.
struct Node {
  std::string kind;  ///< "scene", "bsdf", "shape", "emitter", "sensor", "film", "sampler", "rfilter", "integrator", ...
  std::string plugin;  ///< the `type` attribute; empty for the scene itself
  std::string id;
  std::string name;  ///< the `name` attribute, if the child was given one; a `ref` gives its own name to the child
  SourceLocation location;         ///< of the element
  SourceLocation plugin_location;  ///< of the `type` value
  std::vector<Property> properties;
  std::vector<std::string> unreadable;  ///< names of properties that were given, but wrongly: complained about already
  /// Children in order of appearance; a `ref` shares the node it refers to. There are no cycles, but a node that is
  /// referred to in many places is reached by many paths: whoever walks the tree should treat each node once.
  struct Child {
    std::string name;  ///< name given at the place of use; may be empty
    std::shared_ptr<const Node> node;
    SourceLocation location;  ///< of the place of use
  };
  std::vector<Child> children;
};

/// "bsdf 'diffuse'"; the scene has no plugin.
std::string name_of(const Node& node);

/// What an older scene says in other words: "'maxDepth' is 'max_depth'".
struct SceneChange {
  SourceLocation location;
  std::string text;
};

/// A whole scene file with its includes, references and parameters resolved.
struct Description {
  std::shared_ptr<const Node> scene;
  /// Folders in which file names are looked up, in this order; after them beside the file that names them.
  std::vector<std::string> search_paths;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< those in use: `$name` and its final value
  MemoryReservation memory = {};                                ///< of all nodes
  std::vector<SceneChange> changes = {};                        ///< of which scenes of old versions were in need
};

}  // namespace norrsken
