// Which properties of a PLY element make up attributes: Mitsuba's naming rules.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/ply_header.h"

namespace norrsken {

/// Texture coordinates go by several names; the first pair of which both are there counts.
struct PlyTexcoordNames {
  std::string_view u, v;
};
inline constexpr PlyTexcoordNames kPlyTexcoordNames[] = {{"u", "v"},
                                                         {"texture_u", "texture_v"},
                                                         {"s", "t"},
                                                         {"texture_s", "texture_t"},
                                                         {"texcoord_s", "texcoord_t"},
                                                         {"texcoord_u", "texcoord_v"}};

struct PlyAttribute {
  std::string name;                     ///< "vertex_color", "face_weight"
  std::vector<std::size_t> properties;  ///< 1 or 3, indices into the element's
};

/// Properties `r g b` or `red green blue` are the attribute `color` (an alpha beside them is left out). Properties that
/// follow each other as PREFIX_x _y _z, PREFIX_0 _1 _2, PREFIX_1 _2 _3 or as the first of those alone are the attribute
/// PREFIX; PREFIX_r _g _b are PREFIX_color. `owner` is put in front: "vertex_" or "face_". Properties of geometry and
/// groups of two or four are no attributes.
std::vector<PlyAttribute> find_ply_attributes(const PlyElement& element, std::string_view owner);

}  // namespace norrsken
