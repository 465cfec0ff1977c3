#include "norrsken/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/memory.h"
#include "base/text.h"
#include "color/tone.h"
#include "film/flip.h"

namespace norrsken {
namespace {

constexpr const char* kColorNames[3] = {"R", "G", "B"};
constexpr const char* kVarianceNames[3] = {"variance.R", "variance.G", "variance.B"};
constexpr double kSignificance = 0.01;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is alive at once at most: tone-mapped planes, FLIP's (opponent colours, filtered ones, features and what a filter
/// works on).
constexpr std::uint64_t kBytesPerPixel = 112;

using Planes = std::array<const std::vector<float>*, 3>;

std::string size_text(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

IoStatus find_colors(const Image& image, const char* which, Planes& planes) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (int c = 0; c < 3; ++c) {
    const Channel* channel = image.find(kColorNames[c]);
    if (channel == nullptr) {
      std::vector<std::string> names;
      for (const Channel& existing : image.channels) names.push_back(existing.name);
      return {std::string(which) + " image has no channel " + kColorNames[c] + "; it has " +
              (names.empty() ? "none" : join(names))};
    }
    if (channel->values.size() != pixels) {
      return {std::string(which) + " image: channel " + kColorNames[c] + " does not have " + size_text(image) +
              " pixels"};
    }
    planes[c] = &channel->values;
  }
  return {};
}

/// Equal values are no distance apart, infinities too.
double difference_of(float a, float b) { return a == b ? 0.0 : static_cast<double>(a) - static_cast<double>(b); }

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

/// The z-score of a difference of the given variance; without variance any difference is infinitely many deviations.
double z_score(double difference, double variance) {
  if (difference == 0) return 0;
  return variance > 0 ? difference / std::sqrt(variance) : std::copysign(kInfinity, difference);
}

std::optional<Comparison::ZTest> z_test(const Image& image_a, const Image& image_b, const Planes& a, const Planes& b) {
  const std::size_t pixels = a[0]->size();
  std::array<const float*, 3> variance_a{}, variance_b{};
  bool any = false;
  for (int c = 0; c < 3; ++c) {
    const auto values_of = [&](const Image& image) -> const float* {
      const Channel* channel = image.find(kVarianceNames[c]);
      return channel != nullptr && channel->values.size() == pixels ? channel->values.data() : nullptr;
    };
    variance_a[c] = values_of(image_a);
    variance_b[c] = values_of(image_b);
    any = any || variance_a[c] != nullptr || variance_b[c] != nullptr;
  }
  if (!any) return std::nullopt;

  Comparison::ZTest result;
  std::vector<double> scores;
  scores.reserve(3 * pixels);
  double squares = 0;
  std::size_t estimates = 0;
  for (int c = 0; c < 3; ++c) {
    double difference_sum = 0, variance_sum = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double of_a = variance_a[c] != nullptr ? variance_a[c][i] : 0.0;
      const double of_b = variance_b[c] != nullptr ? variance_b[c][i] : 0.0;
      if (!(of_a >= 0 && of_a < kInfinity && of_b >= 0 && of_b < kInfinity)) continue;  // unknown: nothing to test
      const double variance = of_a + of_b, difference = difference_of((*a[c])[i], (*b[c])[i]);
      const double z = z_score(difference, variance);
      scores.push_back(z);
      difference_sum += difference;
      variance_sum += variance;
      if (variance > 0) {
        squares += z * z;
        ++estimates;
      }
    }
    result.mean_z[c] = z_score(difference_sum, variance_sum);
  }
  if (scores.empty()) return std::nullopt;

  // Sidak: each of n independent tests at this level rejects nothing with probability 1 - kSignificance in all.
  const double level = -std::expm1(std::log1p(-kSignificance) / static_cast<double>(scores.size()));
  const auto passed = std::ranges::count_if(
      scores, [level](double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2) >= level; });
  result.passed_share = static_cast<double>(passed) / static_cast<double>(scores.size());
  result.rms_z = estimates > 0 ? std::sqrt(squares / static_cast<double>(estimates)) : 0.0;
  return result;
}

}  // namespace

IoStatus compare(const Image& a, const Image& b, const CompareOptions& options, Comparison& result, Image* difference) {
  if (a.width != b.width || a.height != b.height) {
    return {"the images differ in size: " + size_text(a) + " and " + size_text(b)};
  }
  if (a.width < 1 || a.height < 1) return {"the images are empty"};
  if (!(options.pixels_per_degree >= 1 && options.pixels_per_degree <= 1000)) {
    return {"pixels per degree: accepted are 1 to 1000"};
  }
  MemoryReservation working;
  try {
    const auto pixels = static_cast<std::uint64_t>(a.width) * static_cast<std::uint64_t>(a.height);
    working = MemoryReservation(pixels * kBytesPerPixel, options.memory);
  } catch (const MemoryExceeded& e) {
    return {std::string("comparing does not fit into memory: ") + e.what()};
  }
  Planes planes_a, planes_b;
  if (IoStatus status = find_colors(a, "the first", planes_a); !status) return status;
  if (IoStatus status = find_colors(b, "the second", planes_b); !status) return status;

  Comparison comparison;
  compare_radiance(planes_a, planes_b, comparison);
  const ToneMapper tone(options.tone);
  const DisplayImage display_a = display_image(a, planes_a, tone), display_b = display_image(b, planes_b, tone);
  comparison.psnr = psnr(display_a, display_b);
  std::vector<float> flip = flip_map(display_b, display_a, options.pixels_per_degree);
  double sum = 0;
  for (const float value : flip) sum += value;
  comparison.flip = sum / static_cast<double>(flip.size());
  comparison.z_test = z_test(a, b, planes_a, planes_b);

  if (difference != nullptr) {
    Image image;
    image.width = a.width;
    image.height = a.height;
    for (int c = 0; c < 3; ++c) {
      std::ranges::transform(*planes_a[c], *planes_b[c], image.channel(kColorNames[c]).values.begin(),
                             [](float x, float y) { return static_cast<float>(std::abs(difference_of(x, y))); });
    }
    image.channel("flip").values = std::move(flip);
    *difference = std::move(image);
  }
  result = comparison;
  return {};
}

}  // namespace norrsken
