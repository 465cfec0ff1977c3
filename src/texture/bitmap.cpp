// bitmap: host side.
//
// Parameters
//   filename     string (required): PNG, JPEG, BMP, TGA, TIFF, PNM, PFM, EXR or HDR
//   filter_type  bilinear (default) or nearest
//   wrap_mode    repeat (default), mirror or clamp
//   raw          boolean (default false): the numbers as they are stored, such as directions and heights. Otherwise
//                8-bit and 16-bit integers are decoded from sRGB
//   to_uv        transform (default identity): of texture coordinates, in x and y
//   format       auto (default), variant or fp16, and accel (boolean): how Mitsuba stores and looks up texels; accepted
//                and without effect
// Stored: to_uv (6 floats), width, height, then words: first texel, stride, byte table, wrap mode, 1 if nearest.
#include "compile/plugins.h"

namespace norrsken {

Texture compile_texture_bitmap(Parameters& p, Builder& builder) {
  const std::string filename = p.file("filename");
  const bool nearest = p.choice("filter_type", "bilinear", {"bilinear", "nearest"}) == "nearest";
  const std::string wrap_mode = p.choice("wrap_mode", "repeat", {"repeat", "mirror", "clamp"});
  const bool raw = p.boolean("raw", false);
  p.choice("format", "auto", {"auto", "variant", "fp16"});
  p.boolean("accel", true);
  ParameterBlock block;
  add_to_uv(block, p.transform("to_uv"));
  if (filename.empty()) return {};
  const auto image = builder.images().load(filename, raw, p.where("filename"));
  if (!image) return {};
  block.add(image->width).add(image->height);
  block.add_word(image->texels).add_word(image->stride).add_word(image->table);
  block.add_word(wrap_mode == "repeat" ? 0 : wrap_mode == "mirror" ? 1 : 2).add_word(nearest);
  return {builder.add_texture(TextureKind::bitmap, block),
          image->mean,
          image->min,
          image->max,
          image->width,
          image->height};
}

}  // namespace norrsken
