#include "formats/byte_image.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <new>

#include "color/srgb.h"

namespace norrsken {
namespace {

std::string read(std::string_view contents, ByteImage& image) {
  try {
    return is_bmp(contents) ? read_bmp(contents, image) : read_targa(contents, image);
  } catch (const std::bad_alloc&) {
    return "not enough memory";
  }
}

/// Channels that are colour or grey.
int color_channels(const ByteImage& image) { return image.channels < 3 ? 1 : 3; }

}  // namespace

bool is_byte_image(std::string_view contents) { return is_bmp(contents) || is_targa(contents); }

std::string read_byte_image(std::string_view contents, std::uint64_t most_bytes, Image& image) {
  ByteImage bytes;
  try {
    const MemoryScope scope(std::make_shared<MemoryBudget>(most_bytes));
    ByteImage counted;
    if (std::string error = read(contents, counted); !error.empty()) return error;
    bytes = std::move(counted);
    const MemoryReservation values(bytes.bytes.size() * sizeof(float));
  } catch (const MemoryExceeded& exceeded) {
    return exceeded.what();
  }
  float decoded[256];
  for (int i = 0; i < 256; ++i) decoded[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
  image.width = bytes.width;
  image.height = bytes.height;
  const char* const names[2][4] = {{"Y", "A"}, {"R", "G", "B", "A"}};
  const int colors = color_channels(bytes);
  for (int c = 0; c < bytes.channels; ++c) {
    Channel& channel = image.channels.emplace_back(Channel{names[colors == 3][c], {}});
    channel.values.reserve(bytes.bytes.size() / bytes.channels);
    for (std::size_t i = c; i < bytes.bytes.size(); i += bytes.channels) {
      const std::uint8_t value = bytes.bytes[i];
      channel.values.push_back(c < colors ? decoded[value] : static_cast<float>(value) / 255.0f);
    }
  }
  return {};
}

std::string read_byte_texels(std::string_view contents, TexelImage& image) {
  ByteImage read_image;
  if (std::string error = read(contents, read_image); !error.empty()) return error;
  image.width = read_image.width;
  image.height = read_image.height;
  image.channels = color_channels(read_image);
  image.is_encoded = true;
  image.bytes = std::move(read_image.bytes);
  if (read_image.channels == image.channels) return {};
  auto end = image.bytes.begin();
  for (auto pixel = image.bytes.begin(); pixel != image.bytes.end(); std::advance(pixel, read_image.channels)) {
    end = std::copy_n(pixel, image.channels, end);
  }
  image.bytes.erase(end, image.bytes.end());
  return {};
}

}  // namespace norrsken
