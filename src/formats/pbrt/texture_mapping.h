// Where on an image or a pattern a point of a surface looks, and what an image shows there.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "formats/pbrt/image_file.h"
#include "formats/pbrt/pattern.h"

namespace norrsken::pbrt {

/// Of the mapping "uv": (s, t) = scale (u, v) + shift.
struct TextureMapping {
  glm::dvec2 scale{1}, shift{0};
  bool is_uv = true;  ///< else it is told that the mean value is taken

  glm::dvec2 at(const glm::dvec2& uv) const { return scale * uv + shift; }
  /// 1 where the whole parts of s and t have an even sum, 0 elsewhere.
  Pattern squares() const;
};
TextureMapping read_mapping(Context& context, Parameters& p);

/// How an image is read.
struct ImageLookup {
  std::string filter = "bilinear", wrap = "repeat";
  double scale = 1;
  bool invert = false;
  bool is_number = false;  ///< of a float texture
  /// The power that stored numbers are taken to; 1: linear. 0: sRGB. Of PNG files alone.
  double gamma = 0;
};
ImageLookup read_lookup(Parameters& p);

/// A number of an image with an alpha channel that says something is that, as in pbrt.
Pattern image_pattern(Context& context, ImageFiles& images, const Parameter& filename, const ImageLookup& lookup,
                      const TextureMapping& mapping);

}  // namespace norrsken::pbrt
