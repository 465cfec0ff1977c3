// A scene in words: what every reader of scene files produces, and what a program may put together by itself. Plugins
// give the words their meaning when the scene is loaded; docs/scenes.md lists them.
//
//   norrsken::Node sphere("shape", "sphere");
//   sphere.set("radius", 2.0).add(norrsken::Node("bsdf", "diffuse").set("reflectance", norrsken::Property::Rgb{{0.8, 0.2, 0.2}}));
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "norrsken/diagnostics.h"
#include "norrsken/image.h"

namespace norrsken {

using FloatArray = std::vector<float>;
using IndexArray = std::vector<std::uint32_t>;

/// Indexed triangles, which shape `mesh` takes as its parameter `mesh`.
struct Mesh {
  /// Values beside the geometry, for textures of type `mesh_attribute` to look up by name.
  struct Attribute {
    std::string name;        ///< with "vertex_" or "face_" in front, which says what the values belong to
    int channels = 1;        ///< 1 or 3
    FloatArray values = {};  ///< so many for each vertex or triangle
  };
  FloatArray positions;  ///< x, y, z of each vertex
  IndexArray triangles;  ///< three vertices each, counter-clockwise seen from the front
  FloatArray normals =
      {};  ///< of each vertex, of any length; or empty, and then the mesh is smooth, or flat if it says so
  FloatArray texcoords = {};  ///< u, v of each vertex; or empty
  std::vector<Attribute> attributes = {};
};

/// A value with a name inside a node: `<float name="fov" value="45"/>`.
struct Property {
  /// Linear sRGB.
  struct Rgb {
    std::array<double, 3> value{};
  };
  /// Pairs of (wavelength in nm, value), ascending; one pair (0, v): the same everywhere.
  struct Spectrum {
    std::vector<std::pair<double, double>> samples = {};
  };
  /// A point or a vector.
  struct Vector {
    std::array<double, 3> value{};
  };
  /// An affine map, row by row as it is written: the point p goes to rows * (p, 1).
  struct Transform {
    std::array<std::array<double, 4>, 4> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  };
  /// Arrays, meshes and images are shared: copies of a description are cheap.
  using Value = std::variant<bool, std::int64_t, double, std::string, Rgb, Spectrum, Vector, Transform,
                             std::shared_ptr<const FloatArray>, std::shared_ptr<const IndexArray>,
                             std::shared_ptr<const Mesh>, std::shared_ptr<const Image>>;

  std::string name;
  Value value;
  std::string type = {};         ///< the word that the file used: "float", "rgb", ...; empty: that of the value
  std::string origin = {};       ///< for a complaint, where it is of `$parameters`: " (from '$fov', set by -Dfov=0)"
  SourceLocation location = {};  ///< of the value
  SourceLocation name_location = {};  ///< of the name
  std::string written = {};           ///< the name that the file has, where it is an older one

  const std::string& file_name() const { return written.empty() ? name : written; }
};

/// The word for a property's type in messages: "float", "rgb", "mesh", ...
std::string type_of(const Property& property);

/// A plugin instance: `<bsdf type="diffuse" id="white"> ... </bsdf>`.
struct Node {
  Node() = default;
  explicit Node(std::string of_kind, std::string of_plugin = {}, std::string with_id = {})
      : kind(std::move(of_kind)), plugin(std::move(of_plugin)), id(std::move(with_id)) {}

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

  // For putting scenes together. A value of that name is replaced.
  Node& set(std::string property, Property::Value value);
  Node& set(std::string property, const char* text) {
    return set(std::move(property), Property::Value(std::string(text)));
  }
  /// A boolean, an integer or a float, by the type of `number`.
  template <class Number>
  requires std::is_arithmetic_v<Number> Node& set(std::string property, Number number) {
    using Stored = std::conditional_t<std::is_same_v<Number, bool>, bool,
                                      std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>>;
    return set(std::move(property), Property::Value(static_cast<Stored>(number)));
  }
  Node& set(std::string property, FloatArray values);
  Node& set(std::string property, IndexArray values);
  Node& set(std::string property, Mesh mesh);
  Node& set(std::string property, Image image);
  /// A child; `as` is its name as a parameter ("reflectance" of a texture).
  Node& add(Node child, std::string as = {});
  /// A node that may be the child of several, as a `ref` makes it. Null is ignored.
  Node& add(std::shared_ptr<const Node> shared, std::string as = {});
};

/// What an older scene says in other words: "'maxDepth' is 'max_depth'".
struct SceneChange {
  SourceLocation location;
  std::string text;
};

/// A whole scene with its includes, references and parameters resolved.
struct Description {
  std::shared_ptr<const Node> scene;  ///< of kind "scene"
  /// Folders in which file names are looked up, in this order; after them beside the file that names them.
  std::vector<std::string> search_paths = {};
  std::vector<std::pair<std::string, std::string>> parameters = {};  ///< those in use: `$name` and its final value
  std::shared_ptr<const void> memory = {};  ///< keeps all nodes counted in the memory budget that they were read in
  std::vector<SceneChange> changes = {};    ///< of which scenes of old versions were in need
};

}  // namespace norrsken
