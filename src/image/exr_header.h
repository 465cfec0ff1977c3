// What has to be true of an OpenEXR file before its library may look at it.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "norrsken/image.h"

namespace norrsken {

/// Bytes that the library decodes at once (a tile, or up to 256 rows), for which it allocates when it opens the
/// file, there or not.
///
/// Nothing, and the library may not look at the file, unless each attribute of the headers is as long as it says and as its
/// type is, so that it ends where the next one begins. The library believes the sizes of some types and allocates them, up
/// to 2 GiB each, before it reads; of others it reads what their type takes, whatever the size says, and then takes what
/// follows for sizes. Nothing of files with an idmanifest, after which the library loses its place by itself, and nothing if
/// the bytes are more than 64 MiB and more than deflate could make of the file.
std::optional<std::uint64_t> exr_block_bytes(std::string_view file);

/// What the first header says, if it is whole in these bytes, the first of a file: size, channels, and attributes that
/// are texts.
std::optional<ImageHeader> read_exr_header(std::string_view begin);

}  // namespace norrsken
