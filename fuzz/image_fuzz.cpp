// Image files of every format that is read, as `norrsken compare` reads them and as textures are read. The reader is
// linked, not loaded, so that its coverage is seen; the libraries behind it are not instrumented.
#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "formats/exr_header.h"
#include "formats/image_oiio.h"
#include "formats/raster_image.h"
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
  const std::string contents(fuzz::text_of(data, size));
  ImageHeader header;
  const auto exr = read_exr_header(contents);
  fuzz::require(!exr || (exr->width > 0 && exr->height > 0), "a header that is read has a size");
  const auto read_at = [&](std::uint64_t at, std::size_t most) {
    return contents.substr(std::min<std::uint64_t>(at, contents.size()), most);
  };
  if (is_png(contents) && read_png_header(read_at, header).empty()) {
    fuzz::require(header.width > 0 && header.height > 0 && !header.channels.empty(), "a PNG has a size and channels");
  }
  const bool is_own = is_raster_image(contents);
  std::string error;
  Image image;
  const bool is_read = is_own ? (error = read_raster_image(contents, kMostBytes, image)).empty()
                              : norrsken_oiio_read("input", contents, kMostBytes, image, error);
  if (is_read) {
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    fuzz::require(pixels > 0 && !image.channels.empty(), "an image has pixels");
    for (const Channel& channel : image.channels) fuzz::require(channel.values.size() == pixels, "channels are whole");
  } else {
    fuzz::require(!error.empty(), "failure is explained");
  }
  const MemoryScope scope(std::make_shared<MemoryBudget>(kMostBytes));
  TexelImage texels;
  std::exception_ptr out_of_memory;
  error.clear();
  try {
    if (is_own) error = read_raster_texels(contents, texels);
  } catch (const MemoryExceeded& exceeded) {
    error = exceeded.what();
  }
  if (is_own ? error.empty() : norrsken_oiio_read_texels("input", contents, texels, error, out_of_memory)) {
    const auto values = static_cast<std::size_t>(texels.width) * static_cast<std::size_t>(texels.height) *
                        static_cast<std::size_t>(texels.channels);
    fuzz::require(values > 0 && texels.bytes.size() + texels.values.size() == values, "texels are whole");
  } else {
    fuzz::require(!error.empty(), "failure is explained");
  }
  return 0;
}

/// Small images gain nothing from threads.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  return 0;
}
