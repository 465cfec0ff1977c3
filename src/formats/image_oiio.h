// The entries of the module that reads images through OpenImageIO.
#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "formats/texel_image.h"
#include "norrsken/image.h"

/// Reads the first image of a file's `contents` into `image`, or says in `error` what is wrong; `path` is for its
/// extension. Images of more than `most_bytes` are refused.
extern "C" bool norrsken_oiio_read(const std::string& path, const std::string& contents, std::uint64_t most_bytes,
                                   norrsken::Image& image, std::string& error) noexcept;

/// What `norrsken::read_texels` does; what that throws is in `out_of_memory`. The image brings its memory budget.
extern "C" bool norrsken_oiio_read_texels(const std::string& path, const std::string& contents,
                                          norrsken::TexelImage& image, std::string& error,
                                          std::exception_ptr& out_of_memory) noexcept;
