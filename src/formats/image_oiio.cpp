#include "formats/image_oiio.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>
#include <vector>

#include "color/srgb.h"

namespace {

using namespace norrsken;

constexpr int kRowsAtATime = 64;

bool is_integer_of(const OIIO::TypeDesc& type, std::size_t bytes) {
  return !type.is_floating_point() && type.size() == bytes;
}

/// Whether the file's colours are stored with the sRGB transfer function.
bool is_srgb(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (is_integer_of(spec.format, 1)) return !OIIO::Strutil::iequals(space, "linear");
  return is_integer_of(spec.format, 2) && OIIO::Strutil::iequals(space, "srgb");
}

/// What a stored value as OpenImageIO hands it out, with integers scaled to [0,1], stands for.
float decoded(float value, bool srgb, bool counted) {
  // 32-bit integers are identifiers or counts, not fractions.
  if (counted) return static_cast<float>(static_cast<double>(value) * 4294967295.0);
  return srgb ? linear_from_srgb(value) : value;
}

/// A complaint of OpenImageIO, which may also fail without a word.
std::string said(const std::string& error) { return error.empty() ? "unknown or damaged image file" : error; }

std::string read(const std::string& path, Image& image) {
  OIIO::ImageSpec request;
  request["oiio:UnassociatedAlpha"] = 1;  // multiplying encoded colours by alpha is wrong
  const auto input = OIIO::ImageInput::open(path, &request);
  if (!input) return said(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.deep || spec.depth > 1) return "deep and volume images are not read";
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) return "it has no pixels";
  if (spec.image_pixels() > kMostImageValues / static_cast<std::size_t>(spec.nchannels)) {
    return "it has " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " pixels of " +
           std::to_string(spec.nchannels) + " channels, accepted are " + std::to_string(kMostImageValues) +
           " values in all";
  }

  image.width = spec.width;
  image.height = spec.height;
  const bool srgb_file = is_srgb(spec);
  std::vector<bool> srgb(spec.nchannels), counted(spec.nchannels);
  for (int c = 0; c < spec.nchannels; ++c) {
    srgb[c] = srgb_file && c != spec.alpha_channel && c != spec.z_channel;
    counted[c] = spec.channelformat(c) == OIIO::TypeDesc::UINT32;
    image.channels.push_back({spec.channel_name(c), std::vector<float>(spec.image_pixels())});
  }
  for (const auto& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeString) image.metadata[attribute.name().string()] = attribute.get_string();
  }

  const int rows_at_a_time = spec.tile_height > 0 ? spec.tile_height : kRowsAtATime;
  const std::size_t channels = static_cast<std::size_t>(spec.nchannels), width = static_cast<std::size_t>(spec.width);
  std::vector<float> block(channels * width * static_cast<std::size_t>(std::min(rows_at_a_time, spec.height)));
  for (int row = 0; row < spec.height; row += rows_at_a_time) {
    const int rows = std::min(rows_at_a_time, spec.height - row), begin = spec.y + row;
    const bool success =
        spec.tile_height > 0
            ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, begin, begin + rows, 0, 1, 0, spec.nchannels,
                                OIIO::TypeFloat, block.data())
            : input->read_scanlines(0, 0, begin, begin + rows, 0, 0, spec.nchannels, OIIO::TypeFloat, block.data());
    if (!success) return said(input->geterror());
    for (std::size_t c = 0; c < channels; ++c) {
      float* out = image.channels[c].values.data() + static_cast<std::size_t>(row) * width;
      for (std::size_t i = 0; i < width * static_cast<std::size_t>(rows); ++i) {
        out[i] = decoded(block[i * channels + c], srgb[c], counted[c]);
      }
    }
  }
  return {};
}

}  // namespace

extern "C" bool norrsken_oiio_read(const std::string& path, norrsken::Image& image, std::string& error) noexcept {
  bool success = false;
  try {
    error = read(path, image);
    success = error.empty();
  } catch (const std::bad_alloc&) {
    error = "not enough memory";
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  return success;
}
