// mesh_attribute: host side.
#include "texture/mesh_attribute.h"

#include "base/text.h"
#include "compile/textures.h"

namespace norrsken {
namespace {

constexpr NumberParameter kScale{.name = "scale", .fallback = 1, .text = "factor on the values"};
constexpr TextParameter kName{.name = "name",
                              .text = "of the attribute, beginning with \"vertex_\" or \"face_\"",
                              .example = R"(<string name="name" value="vertex_color"/>)"};

}  // namespace

Texture compile_texture_mesh_attribute(Parameters& p, Textures& textures) {
  const double scale = p.read(kScale);
  const std::string name = p.read(kName);
  if (!p.has(kName.name)) return {};
  if (!name.starts_with("vertex_") && !name.starts_with("face_")) {
    p.error(kName.name, quoted(name) + " is not the name of a mesh's attribute", "vertex_... or face_...");
    return {};
  }
  using Stored = isa_host::MeshAttribute::Stored;
  const TextureWord word = textures.add(Stored{.scale = static_cast<float>(scale), .table = 0});
  textures.look_up_attribute(name, word, isa_host::floats_before(&Stored::table));
  return {word};
}

}  // namespace norrsken
