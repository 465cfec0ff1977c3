// What a texture becomes, and parameters that may be one.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <limits>

#include "scene/scene_color.h"
#include "tables/slots.h"

namespace norrsken {

struct SourceLocation;

/// A texture, and what is known of its values, if anything. Word 0: none, after a complaint.
struct Texture {
  TextureWord word = 0;
  glm::dvec3 mean{0.5};
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();
  std::uint32_t width = 1, height = 1;  ///< in texels, for what has any
  TextureWord number = 0;               ///< in place of `word` where it stands for a number, if that is another one
  /// The same with all values brought into a range; empty where they were written by hand.
  std::function<Texture(double min, double max, const SourceLocation&)> clamped = {};
};

/// A colour, or a texture; `color` then describes it.
struct ColorOrTexture {
  SceneColor color;
  TextureWord texture = 0;

  glm::dvec3 rgb() const { return color.rgb(); }
  bool is_black() const { return texture == 0 && color.is_black(); }
  operator ColorSlot() const {
    const glm::vec3 c(rgb());
    return {{c.x, c.y, c.z}, texture};
  }
};

/// A number, or a texture; `value` then describes it.
struct NumberOrTexture {
  double value = 0;
  TextureWord texture = 0;

  bool is_zero() const { return texture == 0 && value == 0; }
  operator NumberSlot() const { return {static_cast<float>(value), texture}; }
};

}  // namespace norrsken
