#include "compile/images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "color/srgb.h"
#include "image/texel_image.h"
#include "scene/within_memory.h"

namespace norrsken {
namespace {

/// Signed 32-bit lanes count texels' floats.
constexpr std::size_t kMaxTexels = std::size_t{1} << 31;

/// What is infinite: the largest number of half precision, in which environments with such suns are stored.
constexpr float kInstead = 65504;

/// Sums of the values that are added to it, channel by channel.
struct Statistics {
  glm::dvec3 sum{0};
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();

  void add(int channel, double value, double times) {
    sum[channel] += value * times;
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

/// An image that a program gives has no path.
std::string image_name(const std::string& path) {
  return path.empty() ? "the image" : "the image " + quoted(path, 200);
}

}  // namespace

std::optional<StoredImage> ImageStore::load(const std::string& path, bool raw, const SourceLocation& named_at) {
  const auto key = std::pair(normal_path(path), raw);
  if (const auto known = images_.find(key); known != images_.end()) return known->second;
  std::optional<StoredImage>& image = images_[key];
  within_memory(named_at, "image " + quoted(path, 200), diagnostics_, [&] { image = read(path, raw, named_at); });
  return image;
}

std::uint32_t ImageStore::byte_table(bool encoded) {
  auto& table = byte_tables_[encoded];
  if (!table) {
    table = static_cast<std::uint32_t>(tables_.texels.size());
    for (int byte = 0; byte < 256; ++byte) {
      const double stored = byte / 255.0;
      tables_.texels.push_back(static_cast<float>(encoded ? linear_from_srgb(stored) : stored));
    }
  }
  return *table;
}

std::optional<StoredImage> ImageStore::read(const std::string& path, bool raw, const SourceLocation& named_at) {
  const auto refuse = [&](const std::string& reason, const std::string& accepted) {
    diagnostics_.error(named_at, fmt::format("cannot read the image {}: {}", quoted(path, 200), reason), accepted);
    return std::nullopt;
  };
  std::string error;
  auto contents = read_counted(files_, path, error);
  if (!contents) return refuse(error, "an image file");
  TexelImage image;
  error = read_texels(contents->bytes, image);
  contents.reset();
  if (!error.empty()) return refuse(error, "a PNG, JPEG, BMP, TGA, TIFF, PNM, PFM, EXR or HDR file");
  return store(image, raw, path, named_at);
}

std::optional<StoredImage> ImageStore::of(Parameters& p, const FileParameter& filename, bool raw) {
  if (!p.has("image")) {
    const std::string path = p.read(filename);
    return path.empty() ? std::nullopt : load(path, raw, p.where(filename.name));
  }
  const std::shared_ptr<const Image> image = p.image("image");
  if (p.has(filename.name)) p.error("image", "both 'image' and 'filename' are given", "one of them");
  if (!image) return std::nullopt;
  if (const auto known = given_images_.find(image.get()); known != given_images_.end()) return known->second;
  std::optional<StoredImage>& stored = given_images_[image.get()];
  within_memory(p.where("image"), "an image", diagnostics_, [&] { stored = copy(*image, p); });
  return stored;
}

std::optional<StoredImage> ImageStore::copy(const Image& image, Parameters& p) {
  std::vector<const Channel*> channels;
  for (const char* name : {"R", "G", "B"}) channels.push_back(image.find(name));
  if (std::ranges::find(channels, nullptr) != channels.end()) channels = {image.find("Y")};
  if (channels.front() == nullptr) {
    p.error("image", "'image' has no colours", "channels R, G and B, or Y");
    return std::nullopt;
  }
  const bool has_pixels = image.width > 0 && image.height > 0;
  const auto pixels = has_pixels ? static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) : 0;
  for (const Channel* channel : channels) {
    if (has_pixels && channel->values.size() == pixels) continue;
    p.error("image",
            fmt::format("channel '{}' of an image of {} x {} has {} values", channel->name, image.width, image.height,
                        channel->values.size()),
            "a value for each of at least one pixel");
    return std::nullopt;
  }
  TexelImage texels;
  texels.width = image.width, texels.height = image.height;
  texels.channels = static_cast<int>(channels.size());
  texels.values.reserve(pixels * channels.size());
  for (std::size_t i = 0; i < pixels; ++i) {
    for (const Channel* channel : channels) texels.values.push_back(channel->values[i]);
  }
  return store(texels, /*raw=*/true, /*path=*/{}, p.where("image"));
}

std::optional<StoredImage> ImageStore::store(const TexelImage& image, bool raw, const std::string& path,
                                             const SourceLocation& named_at) {
  const auto warn = [&](const std::string& message) {
    diagnostics_.warning(named_at, fmt::format("{} {}", image_name(path), message));
  };
  auto& texels = tables_.texels;
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const bool packed = !image.bytes.empty();
  const std::size_t needed = packed ? pixels + 512 : pixels * channels;
  if (!image.remark.empty()) warn(image.remark);
  if (!has_room(needed, path, named_at)) return std::nullopt;

  StoredImage stored;
  stored.path = path;
  stored.width = static_cast<std::uint32_t>(image.width);
  stored.height = static_cast<std::uint32_t>(image.height);
  const bool decode = image.is_encoded && !raw;
  Statistics statistics;
  if (packed) {
    stored.table = byte_table(decode);
    stored.texels = static_cast<std::uint32_t>(texels.size());
    texels.reserve(texels.size() + pixels);
    std::array<std::array<std::size_t, 256>, 3> histogram{};
    for (std::size_t i = 0; i < image.bytes.size(); i += channels) {
      std::uint32_t word = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint8_t byte = image.bytes[i + std::min(c, channels - 1)];
        word |= std::uint32_t{byte} << (8 * c);
        ++histogram[c][byte];
      }
      texels.push_back(std::bit_cast<float>(word));
    }
    for (int c = 0; c < 3; ++c) {
      for (std::size_t byte = 0; byte < 256; ++byte) {
        const std::size_t count = histogram[static_cast<std::size_t>(c)][byte];
        if (count > 0) statistics.add(c, double{texels[stored.table + byte]}, static_cast<double>(count));
      }
    }
  } else {
    stored.stride = static_cast<std::uint32_t>(channels);
    stored.texels = static_cast<std::uint32_t>(texels.size());
    texels.reserve(texels.size() + image.values.size());
    std::size_t not_finite = 0;
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      float value = decode ? linear_from_srgb(image.values[i]) : image.values[i];
      if (!std::isfinite(value)) {
        ++not_finite;
        value = std::isnan(value) ? 0 : std::copysign(kInstead, value);
      }
      texels.push_back(value);
      statistics.add(static_cast<int>(i % channels), double{value}, 1);
    }
    if (not_finite > 0) {
      warn(fmt::format("has {} value{} not finite: infinite ones are taken for {:g}, others for 0", not_finite,
                       not_finite == 1 ? " that is" : "s that are", kInstead));
    }
  }
  stored.mean = statistics.sum / static_cast<double>(pixels);
  if (channels == 1 && !packed) stored.mean = glm::dvec3(stored.mean.x);
  stored.min = statistics.min;
  stored.max = statistics.max;
  return stored;
}

bool ImageStore::has_room(std::size_t texels, const std::string& path, const SourceLocation& named_at) {
  if (texels < kMaxTexels - std::min(tables_.texels.size(), kMaxTexels)) return true;
  diagnostics_.error(named_at,
                     fmt::format("cannot read {}: the scene's images are too many or too large", image_name(path)),
                     fmt::format("{} texels in all", kMaxTexels));
  return false;
}

std::optional<StoredImage> ImageStore::clamped(const StoredImage& image, double min, double max,
                                               const SourceLocation& named_at) {
  std::optional<StoredImage> result;
  within_memory(named_at, "a copy of an image", diagnostics_, [&] {
    const std::size_t channels = image.stride, count = channels * image.width * image.height;
    if (!has_room(count, image.path, named_at)) return;
    auto& texels = tables_.texels;
    StoredImage copy = image;
    copy.texels = static_cast<std::uint32_t>(texels.size());
    texels.reserve(texels.size() + count);
    Statistics statistics;
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = static_cast<float>(std::clamp(double{texels[image.texels + i]}, min, max));
      texels.push_back(value);
      statistics.add(static_cast<int>(i % channels), double{value}, 1);
    }
    copy.mean = statistics.sum / static_cast<double>(count / channels);
    if (channels == 1) copy.mean = glm::dvec3(copy.mean.x);
    copy.min = statistics.min, copy.max = statistics.max;
    result = copy;
  });
  return result;
}

}  // namespace norrsken
