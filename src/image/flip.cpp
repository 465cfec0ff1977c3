#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "color/srgb.h"

namespace norrsken {
namespace {

using Plane = std::vector<float>;

// Constants of the paper's section 4.
constexpr double kColorExponent = 0.7;    // q_c
constexpr double kFeatureExponent = 0.5;  // q_f
constexpr double kColorSplit = 0.4;       // p_c: the share of the greatest colour difference ...
constexpr double kErrorAtSplit = 0.95;    // p_t: ... that becomes this error
constexpr double kFeatureWidth = 0.082;   // w, in degrees: the width of a visible feature
constexpr double kLargestSpread = 0.04;   // the largest b of the contrast sensitivity functions below

/// One term of a contrast sensitivity function in the spatial domain: a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct CsfTerm {
  double a, b;
};
constexpr CsfTerm kCsfAchromatic{1.0, 0.0047};
constexpr CsfTerm kCsfRedGreen{1.0, 0.0053};
constexpr CsfTerm kCsfBlueYellow[2]{{34.1, 0.04}, {13.5, 0.025}};

/// A one-dimensional filter of 2 * radius + 1 taps.
struct Filter {
  int radius;
  std::vector<double> taps;
};

template <class Function>
Filter make_filter(int radius, Function&& value_at) {
  Filter filter{radius, {}};
  for (int i = -radius; i <= radius; ++i) filter.taps.push_back(value_at(i));
  return filter;
}

/// Scales positive taps to the sum 1 and negative ones to -1, as the paper normalizes its feature detectors; of a
/// filter without negative taps this is its sum.
Filter normalized(Filter filter) {
  double positive = 0, negative = 0;
  for (const double tap : filter.taps) (tap > 0 ? positive : negative) += tap;
  for (double& tap : filter.taps) tap /= tap > 0 ? positive : (negative < 0 ? -negative : 1.0);
  return filter;
}

/// The plane filtered along x, then along y; beyond the border it goes on with the border's values.
Plane filtered(const Plane& in, int width, int height, const Filter& along_x, const Filter& along_y) {
  Plane between(in.size(), 0.0f), out(in.size(), 0.0f);
  std::vector<float> padded(static_cast<std::size_t>(width + 2 * along_x.radius));
  for (int y = 0; y < height; ++y) {
    const float* row = in.data() + static_cast<std::size_t>(y) * width;
    std::fill_n(padded.begin(), along_x.radius, row[0]);
    std::copy_n(row, width, padded.begin() + along_x.radius);
    std::fill_n(padded.end() - along_x.radius, along_x.radius, row[width - 1]);
    float* sum = between.data() + static_cast<std::size_t>(y) * width;
    for (int i = 0; i <= 2 * along_x.radius; ++i) {
      const float tap = static_cast<float>(along_x.taps[i]);
      for (int x = 0; x < width; ++x) sum[x] += tap * padded[static_cast<std::size_t>(x) + i];
    }
  }
  for (int y = 0; y < height; ++y) {
    float* sum = out.data() + static_cast<std::size_t>(y) * width;
    for (int i = -along_y.radius; i <= along_y.radius; ++i) {
      const float tap = static_cast<float>(along_y.taps[i + along_y.radius]);
      const float* row = between.data() + static_cast<std::size_t>(std::clamp(y + i, 0, height - 1)) * width;
      for (int x = 0; x < width; ++x) sum[x] += tap * row[x];
    }
  }
  return out;
}

// --- colour spaces -----------------------------------------------------------------------------------------------

const ColorVector kWhite = kXyzFromSrgb * ColorVector{1, 1, 1};

/// Y Cx Cz, the opponent space that the contrast sensitivity functions are given for; white is (100, 0, 0).
ColorVector ycxcz_from_rgb(const ColorVector& rgb) {
  const ColorVector xyz = kXyzFromSrgb * rgb;
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

ColorVector rgb_from_ycxcz(const ColorVector& ycxcz) {
  const double y = (ycxcz[0] + 16) / 116;
  const double x = y + ycxcz[1] / 500, z = y - ycxcz[2] / 200;
  return kSrgbFromXyz * ColorVector{x * kWhite[0], y * kWhite[1], z * kWhite[2]};
}

/// CIE L*a*b* with the chroma scaled by the lightness (the Hunt effect: dark colours look less colourful).
ColorVector hunt_lab_from_rgb(const ColorVector& rgb) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const ColorVector xyz = kXyzFromSrgb * rgb;
  const double x = f(xyz[0] / kWhite[0]), y = f(xyz[1] / kWhite[1]), z = f(xyz[2] / kWhite[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

/// HyAB: city-block distance in lightness, Euclidean in chroma (Abasi et al. 2020).
double hyab(const ColorVector& a, const ColorVector& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// --- the two pipelines -------------------------------------------------------------------------------------------

struct Opponent {
  Plane y, cx, cz;
};

Opponent opponent_from_display(const DisplayImage& image) {
  const std::size_t count = image.planes[0].size();
  Opponent result{Plane(count), Plane(count), Plane(count)};
  for (std::size_t i = 0; i < count; ++i) {
    ColorVector rgb;
    for (int c = 0; c < 3; ++c) rgb[c] = linear_from_srgb(image.planes[c][i]);
    const ColorVector ycxcz = ycxcz_from_rgb(rgb);
    result.y[i] = static_cast<float>(ycxcz[0]);
    result.cx[i] = static_cast<float>(ycxcz[1]);
    result.cz[i] = static_cast<float>(ycxcz[2]);
  }
  return result;
}

/// What is left of an image after the eye's contrast sensitivity has blurred it.
class ContrastSensitivity {
 public:
  explicit ContrastSensitivity(double pixels_per_degree)
      : radius_(static_cast<int>(
            std::ceil(3 * std::sqrt(kLargestSpread / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree))),
        achromatic_(normalized(gaussian(kCsfAchromatic.b, pixels_per_degree))),
        red_green_(normalized(gaussian(kCsfRedGreen.b, pixels_per_degree))) {
    // The weight of each term is its share of the two-dimensional filter's sum.
    double total = 0;
    for (int term = 0; term < 2; ++term) {
      const auto [a, b] = kCsfBlueYellow[term];
      const Filter filter = gaussian(b, pixels_per_degree);
      double sum = 0;
      for (const double tap : filter.taps) sum += tap;
      blue_yellow_[term] = normalized(filter);
      weight_[term] = a * std::sqrt(std::numbers::pi / b) * sum * sum;
      total += weight_[term];
    }
    for (double& weight : weight_) weight /= total;
  }

  Opponent operator()(const Opponent& in, int width, int height) const {
    Opponent out{filtered(in.y, width, height, achromatic_, achromatic_),
                 filtered(in.cx, width, height, red_green_, red_green_),
                 filtered(in.cz, width, height, blue_yellow_[0], blue_yellow_[0])};
    const Plane second = filtered(in.cz, width, height, blue_yellow_[1], blue_yellow_[1]);
    for (std::size_t i = 0; i < second.size(); ++i) {
      out.cz[i] = static_cast<float>(weight_[0]) * out.cz[i] + static_cast<float>(weight_[1]) * second[i];
    }
    return out;
  }

 private:
  Filter gaussian(double b, double pixels_per_degree) const {
    return make_filter(radius_, [&](int i) {
      const double degrees = i / pixels_per_degree;
      return std::exp(-std::numbers::pi * std::numbers::pi * degrees * degrees / b);
    });
  }

  int radius_;
  Filter achromatic_, red_green_, blue_yellow_[2];
  double weight_[2] = {};
};

ColorVector hunt_lab_at(const Opponent& image, std::size_t i) {
  ColorVector rgb = rgb_from_ycxcz({image.y[i], image.cx[i], image.cz[i]});
  for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
  return hunt_lab_from_rgb(rgb);
}

/// Stretches colour differences so that small ones, which the eye tells apart best, take most of [0,1].
class ErrorRemapping {
 public:
  double operator()(double distance) const {
    const double difference = std::pow(distance, kColorExponent);
    const double split = kColorSplit * largest_;
    if (difference < split) return kErrorAtSplit / split * difference;
    return kErrorAtSplit + (difference - split) / (largest_ - split) * (1 - kErrorAtSplit);
  }

 private:
  /// Green and blue are the colours of the sRGB gamut that lie farthest apart.
  double largest_ = std::pow(hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), kColorExponent);
};

/// Strength of edges and of points (thin lines included) in the achromatic plane.
struct Features {
  Plane edges, points;
};

class FeatureDetector {
 public:
  explicit FeatureDetector(double pixels_per_degree) {
    const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gauss = [&](int i) { return std::exp(-0.5 * i * i / (deviation * deviation)); };
    smooth_ = normalized(make_filter(radius, gauss));
    first_ = normalized(make_filter(radius, [&](int i) { return -i * gauss(i); }));
    second_ = normalized(make_filter(radius, [&](int i) { return (i * i / (deviation * deviation) - 1) * gauss(i); }));
  }

  Features operator()(const Plane& y, int width, int height) const {
    Plane achromatic(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) achromatic[i] = (y[i] + 16) / 116;
    return {strength(achromatic, width, height, first_), strength(achromatic, width, height, second_)};
  }

 private:
  Plane strength(const Plane& in, int width, int height, const Filter& derivative) const {
    Plane result = filtered(in, width, height, derivative, smooth_);
    const Plane along_y = filtered(in, width, height, smooth_, derivative);
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = std::sqrt(result[i] * result[i] + along_y[i] * along_y[i]);
    }
    return result;
  }

  Filter smooth_, first_, second_;
};

}  // namespace

std::vector<float> flip_map(const DisplayImage& reference, const DisplayImage& test, double pixels_per_degree) {
  const int width = reference.width, height = reference.height;
  const Opponent opponent[2] = {opponent_from_display(reference), opponent_from_display(test)};

  const ContrastSensitivity see(pixels_per_degree);
  const Opponent seen[2] = {see(opponent[0], width, height), see(opponent[1], width, height)};
  const FeatureDetector detect(pixels_per_degree);
  const Features features[2] = {detect(opponent[0].y, width, height), detect(opponent[1].y, width, height)};

  const ErrorRemapping remap;
  std::vector<float> result(opponent[0].y.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double color = remap(hyab(hunt_lab_at(seen[0], i), hunt_lab_at(seen[1], i)));
    const double feature = std::max(std::abs(features[0].edges[i] - features[1].edges[i]),
                                    std::abs(features[0].points[i] - features[1].points[i]));
    const double sharpened = std::pow(feature / std::numbers::sqrt2, kFeatureExponent);
    result[i] = static_cast<float>(std::clamp(std::pow(color, 1 - sharpened), 0.0, 1.0));
  }
  return result;
}

}  // namespace norrsken
