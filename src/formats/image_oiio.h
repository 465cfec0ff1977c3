// The entries of the module that reads images through OpenImageIO.
#pragma once

#include <string>

#include "formats/texel_image.h"
#include "norrsken/image.h"

/// Reads the first image of a file's `contents` into `image`, or says in `error` what is wrong; `path` is for its
/// extension.
extern "C" bool norrsken_oiio_read(const std::string& path, const std::string& contents, norrsken::Image& image,
                                   std::string& error) noexcept;

/// What `norrsken::read_texels` does.
extern "C" bool norrsken_oiio_read_texels(const std::string& path, const std::string& contents, std::size_t max_bytes,
                                          norrsken::TexelImage& image, std::string& error) noexcept;

namespace norrsken {

/// Values that an image may have in all, so that a forged header cannot ask for all the memory: 4 GiB of float.
inline constexpr std::size_t kMostImageValues = std::size_t{1} << 30;

}  // namespace norrsken
