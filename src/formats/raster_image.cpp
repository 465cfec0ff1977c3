#include "formats/raster_image.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <new>
#include <utility>

#include "color/srgb.h"

namespace norrsken {
namespace {

std::string read(std::string_view contents, RasterImage& image) {
  if (is_png(contents)) return read_png(contents, image);
  if (is_radiance(contents)) return read_radiance(contents, image);
  return is_bmp(contents) ? read_bmp(contents, image) : read_targa(contents, image);
}

/// Channels that are colour or grey.
int color_channels(const RasterImage& image) { return image.channels < 3 ? 1 : 3; }

/// Leaves the first `wanted` of each pixel's `channels`.
template <class T>
void keep_channels(Array<T>& values, int channels, int wanted) {
  if (channels == wanted) return;
  auto end = values.begin();
  for (auto pixel = values.begin(); pixel != values.end(); std::advance(pixel, channels)) {
    end = std::copy_n(pixel, wanted, end);
  }
  values.erase(end, values.end());
}

/// Appends the channels as floats; `most` is what 1 is stored as.
template <class T>
void add_channels(const RasterImage& read, const Array<T>& values, float most, Image& image) {
  const char* const names[2][4] = {{"Y", "A"}, {"R", "G", "B", "A"}};
  const int colors = color_channels(read);
  for (int c = 0; c < read.channels; ++c) {
    Channel& channel = image.channels.emplace_back(Channel{names[colors == 3][c], {}});
    channel.values.reserve(values.size() / read.channels);
    for (std::size_t i = c; i < values.size(); i += read.channels) {
      const float value = static_cast<float>(values[i]) / most;
      channel.values.push_back(c < colors && !read.is_linear ? linear_from_srgb(value) : value);
    }
  }
}

}  // namespace

bool is_raster_image(std::string_view contents) {
  return is_bmp(contents) || is_png(contents) || is_radiance(contents) || is_targa(contents);
}

std::string read_raster_image(std::string_view contents, std::uint64_t most_bytes, Image& image) try {
  const MemoryScope scope(std::make_shared<MemoryBudget>(most_bytes));
  RasterImage raster;
  if (std::string error = read(contents, raster); !error.empty()) return error;
  const MemoryReservation floats((raster.bytes.size() + raster.words.size() + raster.floats.size()) * sizeof(float));
  image.width = raster.width;
  image.height = raster.height;
  image.metadata = std::move(raster.metadata);
  if (!raster.floats.empty()) {
    add_channels(raster, raster.floats, 1, image);
  } else if (!raster.words.empty()) {
    add_channels(raster, raster.words, 65535, image);
  } else {
    add_channels(raster, raster.bytes, 255, image);
  }
  return {};
} catch (const MemoryExceeded& exceeded) {
  return exceeded.what();
} catch (const std::bad_alloc&) {
  return "not enough memory";
}

std::string read_raster_texels(std::string_view contents, TexelImage& image) try {
  RasterImage raster;
  if (std::string error = read(contents, raster); !error.empty()) return error;
  image.width = raster.width;
  image.height = raster.height;
  image.channels = color_channels(raster);
  image.is_encoded = !raster.is_linear;
  keep_channels(raster.floats, raster.channels, image.channels);
  keep_channels(raster.bytes, raster.channels, image.channels);
  keep_channels(raster.words, raster.channels, image.channels);
  image.bytes = std::move(raster.bytes);
  image.values = std::move(raster.floats);
  image.values.reserve(raster.words.size());
  for (const std::uint16_t word : raster.words) image.values.push_back(static_cast<float>(word) / 65535.0f);
  return {};
} catch (const std::bad_alloc&) {
  return "not enough memory";
}

}  // namespace norrsken
