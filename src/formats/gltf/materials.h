// glTF's materials as BSDFs, and what shines of them.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "formats/gltf/images.h"

namespace norrsken::gltf {

/// What of a primitive matters to its material.
struct PrimitiveTraits {
  std::vector<std::size_t> sets = {};  ///< of texture coordinates that there are
  bool has_colors = false;             ///< of vertices, as the attribute "vertex_color"
  bool has_alpha = false;              ///< the same with "vertex_alpha"
  bool is_mirrored = false;            ///< its texture coordinates are: normal maps are upside down
  auto operator<=>(const PrimitiveTraits&) const = default;
};

/// What a primitive becomes of its material.
struct Surface {
  std::shared_ptr<const Node> bsdf;
  std::shared_ptr<const Node> emitter;  ///< null if it does not shine
  bool shines_on_both_sides = false;
};

class Materials {
 public:
  explicit Materials(Asset& asset) : asset_(asset), images_(asset) {}

  /// The material of a primitive, or glTF's default one. Null after a complaint.
  const Json* of_primitive(const Json& primitive);
  const Surface& surface(const Json* material, const PrimitiveTraits& traits);
  /// Which set of texture coordinates the material's textures are looked up with: the first of them decides.
  std::size_t set_of(const Json* material, const std::vector<std::size_t>& available);
  bool has_normal_map(const Json* material);

 private:
  std::optional<std::size_t> variant_number();

  Asset& asset_;
  Images images_;
  std::map<std::pair<const Json*, PrimitiveTraits>, Surface> surfaces_;
  std::optional<std::optional<std::size_t>> variant_;  ///< once it has been looked for
};

}  // namespace norrsken::gltf
