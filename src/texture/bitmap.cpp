// bitmap: host side.
//
// Values of an image that are out of the range of what they stand for are clamped, with a warning. So are infinite ones, at
// 65504 (the largest of half precision), and what is no number is 0. EXR: the channels R G B, X Y Z (CIE, turned into sRGB)
// or Y, of any layer; a warning says which others are taken for them. HDR: RGBE and XYZE, rows and columns in any order;
// EXPOSURE and GAMMA are not heeded, as in Mitsuba.
#include "texture/bitmap.h"

#include <algorithm>

#include "compile/images.h"
#include "compile/textures.h"
#include "texture/texture_host.h"

namespace norrsken {
namespace {

constexpr FileParameter kFilename{
    .name = "filename",
    .text = "PNG, JPEG, BMP, TGA, TIFF, PNM, PFM, EXR or HDR. Programs may give an `image` in its place"};
/// The number of a mode is what the kernel knows it by.
using WrapMode = ChoiceParameter<std::uint32_t>;
constexpr auto kWrapModes = decltype(WrapMode::words){{{"repeat", 0}, {"mirror", 1}, {"clamp", 2}}};

constexpr ChoiceParameter<bool> kIsNearest{.name = "filter_type",
                                           .words = {{{"bilinear", false}, {"nearest", true}}},
                                           .text = "what there is between texel centres"};
constexpr WrapMode kWrapMode{
    .name = "wrap_mode", .words = kWrapModes, .text = "what there is beyond the image's edges"};
constexpr WrapMode kWrapModeU{
    .name = "wrap_mode_u", .words = kWrapModes, .text = "the same of u alone, as in Mitsuba 0.6"};
constexpr WrapMode kWrapModeV{
    .name = "wrap_mode_v", .words = kWrapModes, .text = "the same of v alone, as in Mitsuba 0.6"};
constexpr BooleanParameter kRaw{
    .name = "raw",
    .text =
        "the numbers as they are stored, such as directions and heights. Otherwise 8-bit and 16-bit integers are "
        "decoded from sRGB, but those of a PNG that says that it is linear: a gAMA chunk of 1 without an sRGB chunk"};
constexpr ChoiceParameter<int> kFormat{.name = "format",
                                       .words = {{{"auto"}, {"variant"}, {"fp16"}}},
                                       .text = "how Mitsuba stores texels; accepted and without effect"};
constexpr BooleanParameter kAccel{
    .name = "accel", .fallback = true, .text = "how Mitsuba looks up texels; accepted and without effect"};

}  // namespace

Texture compile_texture_bitmap(Parameters& p, Textures& textures) {
  const bool nearest = p.read(kIsNearest);
  const std::uint32_t wrap_mode = p.read(kWrapMode);
  const std::uint32_t wrap_u = p.read(kWrapModeU.or_else(wrap_mode)), wrap_v = p.read(kWrapModeV.or_else(wrap_mode));
  const bool raw = p.read(kRaw);
  p.read(kFormat);
  p.read(kAccel);
  const isa_host::ToUvSlots to_uv = to_uv_slots(p.read(kToUv));
  const auto image = textures.images().of(p, kFilename, raw);
  if (!image) return {};
  const isa_host::ToUvSlots unchanged{{{1, 0, 0}, {0, 1, 0}}};
  const bool mapped = !std::equal(&to_uv.rows[0][0], &to_uv.rows[0][0] + 6, &unchanged.rows[0][0]);
  using Bitmap = isa_host::Bitmap;
  const std::uint32_t flags =
      (wrap_u + 4 * wrap_v) << Bitmap::kWrapShift | (nearest ? Bitmap::kNearest : 0) | (mapped ? Bitmap::kMapped : 0);
  // With tools of their own: `clamped` is called when those of this call are gone.
  auto texture_of = [textures, to_uv, flags](const StoredImage& stored) mutable {
    return Texture{textures.add(Bitmap::Stored{.to_uv = to_uv,
                                               .width = static_cast<float>(stored.width),
                                               .height = static_cast<float>(stored.height),
                                               .texels = stored.texels,
                                               .table = stored.table,
                                               .flags = flags | stored.stride}),
                   stored.mean,
                   stored.min,
                   stored.max,
                   stored.width,
                   stored.height};
  };
  Texture texture = texture_of(*image);
  // Bytes are fractions, which every range has.
  if (image->stride == 0) return texture;
  texture.clamped = [textures, texture_of, image](double min, double max, const SourceLocation& place) mutable {
    const auto clamped = textures.images().clamped(*image, min, max, place);
    return clamped ? texture_of(*clamped) : Texture{};
  };
  return texture;
}

}  // namespace norrsken
