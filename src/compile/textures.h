// What textures are compiled with, and the host function of each: what src/texture/NAME.cpp defines.
#pragma once

#include <string>

#include "compile/plugin_tools.h"

namespace norrsken {

class ImageStore;

class Textures : public TexturedTools {
 public:
  using TexturedTools::TexturedTools;

  /// Stores a texture's block and returns the word that leads to it.
  template <class Stored>
  TextureWord add(const Stored& stored) {
    return add(Stored::kKind, floats_of(stored));
  }
  ImageStore& images();
  /// The word of the texture `texture`, `floats_before` it in its block, will lead to the table of the attribute `name`
  /// of meshes.
  void look_up_attribute(const std::string& name, TextureWord texture, std::uint32_t floats_before);

 private:
  TextureWord add(TextureKind kind, std::span<const float> block);
};

using CompileTexture = Texture(Parameters&, Textures&);

#define NORRSKEN_TEXTURE(kind, Model) CompileTexture compile_texture_##kind;
#include "lists/texture.def"
#undef NORRSKEN_TEXTURE

}  // namespace norrsken
