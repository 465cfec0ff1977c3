// mesh_attribute: host side.
//
// Parameters
//   name   string (required): of the attribute, beginning with "vertex_" or "face_"
//   scale  number (default 1): factor on the values
// Stored: scale, then the word of the attribute's table of shapes.
#include <limits>

#include "base/text.h"
#include "compile/plugins.h"

namespace norrsken {

Texture compile_texture_mesh_attribute(Parameters& p, Builder& builder) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const double scale = p.number("scale", 1, -kAny, kAny);
  const std::string name = p.text("name", "");
  if (!p.require("name", "<string name=\"name\" value=\"vertex_color\"/>")) return {};
  if (!name.starts_with("vertex_") && !name.starts_with("face_")) {
    p.error("name", quoted(name) + " is not the name of a mesh's attribute", "vertex_... or face_...");
    return {};
  }
  const TextureWord word = builder.add_texture(TextureKind::mesh_attribute, ParameterBlock().add(scale).add_word(0));
  builder.attributes().look_up(name, (word & kTextureOffsetMask) + 1);
  return {word};
}

}  // namespace norrsken
