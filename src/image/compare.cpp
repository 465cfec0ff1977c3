#include "norrsken/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/memory.h"
#include "base/text.h"
#include "color/srgb.h"
#include "color/tone.h"
#include "image/flip.h"
#include "image/z_test.h"

namespace norrsken {
namespace {

constexpr const char* kColorNames[3] = {"R", "G", "B"};
constexpr const char* kVarianceNames[3] = {"variance.R", "variance.G", "variance.B"};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is alive at once at most: tone-mapped planes, FLIP's (opponent colours, filtered ones, features and what a filter
/// works on), and converted colours and variances of both.
constexpr std::uint64_t kBytesPerPixel = 144;

using Values = std::vector<float>;

/// One image as it is compared.
struct Picture {
  Planes colors{}, variances{};  ///< variances are null where there are none
  bool is_luminance = false;
  std::vector<Values> converted;  ///< what colours and variances point to if the image does not have them so
};

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

/// Null if the image does not have all three.
std::optional<Planes> find_three(const Image& image, const char* const (&names)[3]) {
  Planes planes{};
  for (int c = 0; c < 3; ++c) {
    const Channel* channel = image.find(names[c]);
    if (channel == nullptr) return std::nullopt;
    planes[c] = &channel->values;
  }
  return planes;
}

template <class Convert>
Values convert(const Planes& from, const Convert& value_of) {
  Values result(from[0]->size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = static_cast<float>(value_of(ColorVector{(*from[0])[i], (*from[1])[i], (*from[2])[i]}));
  }
  return result;
}

IoStatus find_colors(const Image& image, const char* which, Picture& picture) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (const Channel& channel : image.channels) {
    if (channel.values.size() == pixels) continue;
    return {std::string(which) + " image: channel " + channel.name + " does not have " + size_text(image) + " pixels"};
  }
  picture.converted.reserve(6);
  if (const auto variances = find_three(image, kVarianceNames)) picture.variances = *variances;
  if (const auto rgb = find_three(image, kColorNames)) {
    picture.colors = *rgb;
  } else if (const auto xyz = find_three(image, {"X", "Y", "Z"})) {
    for (int c = 0; c < 3; ++c) {
      const auto component = [c](const ColorVector& v) { return (kSrgbFromXyz * v)[c]; };
      picture.colors[c] = &picture.converted.emplace_back(convert(*xyz, component));
    }
  } else if (const Channel* luminance = image.find("Y")) {
    picture.is_luminance = true;
    picture.colors.fill(&luminance->values);
  } else {
    std::vector<std::string> names;
    for (const Channel& existing : image.channels) names.push_back(existing.name);
    return {std::string(which) + " image has neither R, G, B nor X, Y, Z nor Y; it has " +
            (names.empty() ? "none" : join(names))};
  }
  return {};
}

/// Colours become luminance; so do variances, as if the channels erred together, which they nearly do.
void reduce_to_luminance(Picture& picture) {
  const auto& weights = kXyzFromSrgb[1];
  if (!picture.is_luminance) {
    picture.colors.fill(&picture.converted.emplace_back(convert(picture.colors, [&](const ColorVector& v) {
      return weights[0] * v[0] + weights[1] * v[1] + weights[2] * v[2];
    })));
  }
  if (picture.variances[0] == nullptr) return;
  picture.variances.fill(&picture.converted.emplace_back(convert(picture.variances, [&](const ColorVector& v) {
    const double deviation = weights[0] * std::sqrt(v[0]) + weights[1] * std::sqrt(v[1]) + weights[2] * std::sqrt(v[2]);
    return deviation * deviation;
  })));
}

std::uint64_t count_nan(const Planes& planes) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < planes[0]->size(); ++i) {
    if (std::ranges::any_of(planes, [i](const Values* plane) { return std::isnan((*plane)[i]); })) ++count;
  }
  return count;
}

void compare_radiance(const Planes& a, const Planes& b, Comparison& result) {
  double squared = 0, relative = 0, sum_a = 0, sum_b = 0;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < a[c]->size(); ++i) {
      const double value_a = (*a[c])[i], value_b = (*b[c])[i];
      const double difference = difference_of((*a[c])[i], (*b[c])[i]);
      squared += difference * difference;
      // A reference of infinity would make inf / inf of what is infinitely wrong.
      relative +=
          std::isfinite(difference) ? difference * difference / (value_b * value_b + 0.01) : std::abs(difference);
      sum_a += value_a;
      sum_b += value_b;
    }
  }
  const double count = 3.0 * static_cast<double>(a[0]->size());
  result.mse = squared / count;
  result.rel_mse = relative / count;
  result.mean_a = sum_a / count;
  result.mean_b = sum_b / count;
}

DisplayImage display_image(const Image& image, const Planes& planes, const ToneMapper& tone) {
  DisplayImage result{image.width, image.height, {}};
  for (int c = 0; c < 3; ++c) {
    result.planes[c].resize(planes[c]->size());
    std::ranges::transform(*planes[c], result.planes[c].begin(), tone);
  }
  return result;
}

double psnr(const DisplayImage& a, const DisplayImage& b) {
  double squared = 0;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < a.planes[c].size(); ++i) {
      const double difference = static_cast<double>(a.planes[c][i]) - static_cast<double>(b.planes[c][i]);
      squared += difference * difference;
    }
  }
  return squared == 0 ? kInfinity : -10 * std::log10(squared / (3.0 * static_cast<double>(a.planes[0].size())));
}

}  // namespace

Result<Comparison> compare(const Image& a, const Image& b, const CompareOptions& options) {
  using Failed = Result<Comparison>;
  if (a.width != b.width || a.height != b.height) {
    return Failed::failure("the images differ in size: " + size_text(a) + " and " + size_text(b));
  }
  if (a.width < 1 || a.height < 1) return Failed::failure("the images are empty");
  if (!(options.pixels_per_degree >= 1 && options.pixels_per_degree <= 1000)) {
    return Failed::failure("pixels per degree: accepted are 1 to 1000");
  }
  MemoryReservation working;
  try {
    const auto pixels = static_cast<std::uint64_t>(a.width) * static_cast<std::uint64_t>(a.height);
    working = MemoryReservation(pixels * kBytesPerPixel, options.memory);
  } catch (const MemoryExceeded& e) {
    return Failed::failure(std::string("comparing does not fit into memory: ") + e.what());
  }
  Picture picture_a, picture_b;
  if (IoStatus status = find_colors(a, "the first", picture_a); !status) return Failed::failure(status.error);
  if (IoStatus status = find_colors(b, "the second", picture_b); !status) return Failed::failure(status.error);
  if (picture_a.is_luminance || picture_b.is_luminance) {
    reduce_to_luminance(picture_a);
    reduce_to_luminance(picture_b);
  }
  const Planes &planes_a = picture_a.colors, &planes_b = picture_b.colors;

  Comparison comparison;
  compare_radiance(planes_a, planes_b, comparison);
  comparison.nan_a = count_nan(planes_a);
  comparison.nan_b = count_nan(planes_b);
  const ToneMapper tone(options.tone);
  const DisplayImage display_a = display_image(a, planes_a, tone), display_b = display_image(b, planes_b, tone);
  std::vector<float> flip = flip_map(display_b, display_a, options.pixels_per_degree);
  if (comparison.nan_a + comparison.nan_b > 0) {
    comparison.psnr = comparison.flip = std::numeric_limits<double>::quiet_NaN();
  } else {
    comparison.psnr = psnr(display_a, display_b);
    double sum = 0;
    for (const float value : flip) sum += value;
    comparison.flip = sum / static_cast<double>(flip.size());
  }
  comparison.z_test = z_test(a.width, planes_a, planes_b, picture_a.variances, picture_b.variances);

  if (options.difference) {
    Image& image = comparison.difference;
    image.width = a.width;
    image.height = a.height;
    for (int c = 0; c < 3; ++c) {
      std::ranges::transform(*planes_a[c], *planes_b[c], image.channel(kColorNames[c]).values.begin(),
                             [](float x, float y) { return static_cast<float>(std::abs(difference_of(x, y))); });
    }
    image.channel("flip").values = std::move(flip);
  }
  return comparison;
}

}  // namespace norrsken
