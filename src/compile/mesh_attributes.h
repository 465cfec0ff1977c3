// Values that meshes have per vertex or triangle, for the textures that look them up by name.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "formats/mesh_data.h"
#include "norrsken/diagnostics.h"
#include "scene/description.h"
#include "tables/scene_tables.h"

namespace norrsken {

class MeshAttributes {
 public:
  explicit MeshAttributes(SceneTables& tables) : tables_(tables) {}

  /// Stores a shape's attributes. `first_vertex` and `first_triangle` are the scene's numbers of the mesh's first ones.
  void add(std::uint32_t shape, std::uint32_t first_vertex, std::uint32_t first_triangle,
           std::span<const MeshAttribute> attributes);

  /// The texture whose parameters are at `offset` looks up `name`: the word there will lead to its table.
  void look_up(const std::string& name, std::uint32_t offset) { lookups_[name].push_back(offset); }

  /// Complains about what the textures of a shape's `node` look up and the shape does not have.
  void check(const Node& node, std::span<const MeshAttribute> attributes, Diagnostics& diagnostics);

  /// Writes the tables when all shapes are known: for each name two words per shape (see texture/mesh_attribute.h).
  void finish();

 private:
  struct Place {
    std::uint32_t shape;
    std::uint32_t offset;  ///< of the value of the scene's vertex or triangle 0, in 32-bit arithmetic
    std::uint32_t channels;
    bool per_face;
  };
  const std::set<std::string>& names_in(const Node& node);

  SceneTables& tables_;
  std::map<std::string, std::vector<Place>, std::less<>> places_;
  std::map<std::string, std::vector<std::uint32_t>> lookups_;
  std::map<const Node*, std::set<std::string>> names_;  ///< that the textures below a node look up
};

}  // namespace norrsken
