// What plugins of every family, or of several, may use. Each family's own tools are in a header of its own: materials.h,
// textures.h, lights.h, shapes.h, frame_tools.h. They are views of the Builder, which no plugin sees.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "compile/texture.h"
#include "scene/parameters.h"

namespace norrsken {

class Builder;

class PluginTools {
 public:
  explicit PluginTools(Builder& builder) : builder_(builder) {}

  /// A line for `norrsken info`.
  void describe(const Node& node, std::string detail);

 protected:
  Builder& builder_;
};

/// Of plugins whose parameters may be textures.
class TexturedTools : public PluginTools {
 public:
  using PluginTools::PluginTools;

  /// A colour, or a texture where a child node of that name stands. Textures that tell their values are held against the
  /// range too, those of files by `within_range`.
  ColorOrTexture read(Parameters& p, const ColorParameter& color);
  NumberOrTexture read(Parameters& p, const NumberParameter& number);
  /// The texture of a `texture` node; one that several parameters refer to is compiled once.
  Texture texture(const Node& node);
  /// The texture of parameter `name` if its values are in range; else a warning, and one whose values are clamped. What
  /// was written by hand is an error there.
  Texture within_range(Parameters& p, std::string_view name, const Texture& texture, const Range& range);
};

}  // namespace norrsken
