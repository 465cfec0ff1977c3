#include "image/raster_image.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "color/srgb.h"

namespace norrsken {
namespace {

struct Format {
  bool (*is_it)(std::string_view contents);
  std::string (*read)(std::string_view contents, RasterImage& image);
};
constexpr Format kFormats[] = {{is_png, read_png},    {is_jpeg, read_jpeg}, {is_radiance, read_radiance},
                               {is_tiff, read_tiff},  {is_pnm, read_pnm},   {is_bmp, read_bmp},
                               {is_targa, read_targa}};

const Format* format_of(std::string_view contents) {
  const auto* found = std::ranges::find_if(kFormats, [&](const Format& format) { return format.is_it(contents); });
  return found == std::end(kFormats) ? nullptr : found;
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

std::string orientation_remark(int orientation) {
  if (orientation <= 1 || orientation > 8) return {};
  return "says that it is to be turned (orientation " + std::to_string(orientation) +
         " in place of 1): it is taken as it is stored";
}

bool is_raster_image(std::string_view contents) { return format_of(contents) != nullptr; }

std::string read_raster_image(std::string_view contents, Image& image) {
  RasterImage raster;
  if (std::string error = format_of(contents)->read(contents, raster); !error.empty()) return error;
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
}

std::string read_raster_texels(std::string_view contents, TexelImage& image) {
  RasterImage raster;
  if (std::string error = format_of(contents)->read(contents, raster); !error.empty()) return error;
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
  image.remark = std::move(raster.remark);
  return {};
}

}  // namespace norrsken
