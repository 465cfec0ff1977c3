// bitmap: host side.
//
// Parameters
//   filename     string (required): PNG, JPEG, BMP, TGA, TIFF, PNM, PFM, EXR or HDR. Programs may give an `image` in its place
//   filter_type  bilinear (default) or nearest
//   wrap_mode    repeat (default), mirror or clamp
//   wrap_mode_u, wrap_mode_v  the same of u or v alone, as in Mitsuba 0.6
//   raw          boolean (default false): the numbers as they are stored, such as directions and heights. Otherwise
//                8-bit and 16-bit integers are decoded from sRGB, but those of a PNG that says that it is linear: a gAMA
//                chunk of 1 without an sRGB chunk
//   to_uv        transform (default identity): of texture coordinates, in x and y
//   format, accel  auto (default), variant or fp16, and a boolean: how Mitsuba stores and looks up texels; accepted and
//                without effect
// Values of an image that are out of the range of what they stand for are clamped, with a warning. So are infinite ones, at
// 65504 (the largest of half precision), and what is no number is 0. EXR: the channels R G B, X Y Z (CIE, turned into sRGB)
// or Y, of any layer; a warning says which others are taken for them. HDR: RGBE and XYZE, rows and columns in any order;
// EXPOSURE and GAMMA are not heeded, as in Mitsuba.
// Stored: to_uv (6 floats), width, height, then words: first texel, stride, byte table, wrap modes
// (that of u and 4 times that of v), 1 if nearest.
#include "compile/plugins.h"

namespace norrsken {
namespace {

std::uint32_t wrap_number(std::string_view mode) { return mode == "repeat" ? 0 : mode == "mirror" ? 1 : 2; }

}  // namespace

Texture compile_texture_bitmap(Parameters& p, Builder& builder) {
  const bool nearest = p.choice("filter_type", "bilinear", {"bilinear", "nearest"}) == "nearest";
  const std::string wrap_mode = p.choice("wrap_mode", "repeat", {"repeat", "mirror", "clamp"});
  const std::uint32_t wrap = wrap_number(p.choice("wrap_mode_u", wrap_mode, {"repeat", "mirror", "clamp"})) +
                             4 * wrap_number(p.choice("wrap_mode_v", wrap_mode, {"repeat", "mirror", "clamp"}));
  const bool raw = p.boolean("raw", false);
  p.choice("format", "auto", {"auto", "variant", "fp16"});
  p.boolean("accel", true);
  ParameterBlock block;
  add_to_uv(block, p.transform("to_uv"));
  const auto image = builder.images().of(p, raw);
  if (!image) return {};
  const auto texture_of = [&builder, block, wrap, nearest](const StoredImage& stored) {
    ParameterBlock whole = block;
    whole.add(stored.width).add(stored.height);
    whole.add_word(stored.texels).add_word(stored.stride).add_word(stored.table).add_word(wrap).add_word(nearest);
    return Texture{builder.add_texture(TextureKind::bitmap, whole),
                   stored.mean,
                   stored.min,
                   stored.max,
                   stored.width,
                   stored.height};
  };
  Texture texture = texture_of(*image);
  // Bytes are fractions, which every range has.
  if (image->stride == 0) return texture;
  texture.clamped = [&builder, texture_of, image](double min, double max, const SourceLocation& place) {
    const auto clamped = builder.images().clamped(*image, min, max, place);
    return clamped ? texture_of(*clamped) : Texture{};
  };
  return texture;
}

}  // namespace norrsken
