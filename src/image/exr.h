// EXR files, through OpenEXR.
#pragma once

#include <string>
#include <string_view>

#include "image/texel_image.h"
#include "norrsken/image.h"

namespace norrsken {

bool is_exr(std::string_view contents);

/// Read the first part out of a file's contents: its data window, of the largest level, whichever way it is compressed.
/// Empty, or what is wrong. What the image and the decoder take is counted; may throw MemoryExceeded.
///
/// All channels by their names, those of a layer together, R, G, B and A first. Integers become floats of their value.
std::string read_exr(std::string_view contents, Image& image);
/// R, G, B; or X, Y, Z, as sRGB; or Y; or the first three channels or the first one, which the remark tells.
std::string read_exr_texels(std::string_view contents, TexelImage& image);

}  // namespace norrsken
