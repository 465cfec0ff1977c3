// Image files of every format that is read, as `norrsken compare` reads them and as textures are read. The libraries behind
// the readers are not instrumented.
#include <algorithm>

#include "fuzz/fuzz.h"
#include "image/exr_header.h"
#include "image/raster_image.h"
#include "image/texel_image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
  const std::string_view contents = fuzz::text_of(data, size);
  ImageHeader header;
  const auto exr = read_exr_header(contents);
  fuzz::require(!exr || (exr->width > 0 && exr->height > 0), "a header that is read has a size");
  const auto read_at = [&](std::uint64_t at, std::size_t most) {
    return contents.substr(std::min<std::uint64_t>(at, contents.size()), most);
  };
  if (is_png(contents) && read_png_header(read_at, header).empty()) {
    fuzz::require(header.width > 0 && header.height > 0 && !header.channels.empty(), "a PNG has a size and channels");
  }
  Image image;
  std::string error = read_image_contents(contents, kMostBytes, image);
  if (error.empty()) {
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    fuzz::require(pixels > 0 && !image.channels.empty(), "an image has pixels");
    for (const Channel& channel : image.channels) fuzz::require(channel.values.size() == pixels, "channels are whole");
  } else {
    fuzz::require(image.channels.empty(), "an image changes on success only");
  }
  const auto budget = std::make_shared<MemoryBudget>(kMostBytes);
  {
    const MemoryScope scope(budget);
    TexelImage texels;
    try {
      error = read_texels(contents, texels);
    } catch (const MemoryExceeded& exceeded) {
      error = exceeded.what();
    }
    if (error.empty()) {
      const auto values = static_cast<std::size_t>(texels.width) * static_cast<std::size_t>(texels.height) *
                          static_cast<std::size_t>(texels.channels);
      fuzz::require(values > 0 && texels.bytes.size() + texels.values.size() == values, "texels are whole");
    }
  }
  fuzz::require(budget->used() == 0, "memory is given back");
  return 0;
}
