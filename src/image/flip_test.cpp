#include "image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace norrsken {
namespace {

constexpr double kPixelsPerDegree = 67;

template <class Function>
DisplayImage made_image(int width, int height, Function&& color_at) {
  DisplayImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) image.planes[c].push_back(static_cast<float>(color_at(x, y, c)));
    }
  }
  return image;
}

DisplayImage uniform(double r, double g, double b, int width = 9, int height = 7) {
  return made_image(width, height, [&](int, int, int c) { return c == 0 ? r : c == 1 ? g : b; });
}

/// CIELAB of the sRGB primaries for D65, as tables list them.
struct Lab {
  double lightness, a, b;
};
constexpr Lab kRed{53.2408, 80.0925, 67.2032};
constexpr Lab kGreen{87.7347, -86.1827, 83.1793};
constexpr Lab kBlue{32.2970, 79.1875, -107.8602};
constexpr Lab kWhite{100, 0, 0};

/// Distance after the chroma is scaled by the lightness.
double distance(const Lab& p, const Lab& q) {
  return std::abs(p.lightness - q.lightness) + std::hypot(p.lightness / 100 * p.a - q.lightness / 100 * q.a,
                                                          p.lightness / 100 * p.b - q.lightness / 100 * q.b);
}

const double kLargest = std::pow(distance(kGreen, kBlue), 0.7);

double remapped(double hyab) {
  const double difference = std::pow(hyab, 0.7), split = 0.4 * kLargest;
  return difference < split ? 0.95 * difference / split : 0.95 + 0.05 * (difference - split) / (kLargest - split);
}

// Filters leave uniform images as they are and find no features in them.
TEST(Flip, UniformImagesDifferByTheirColor) {
  const auto error = [](const DisplayImage& a, const DisplayImage& b) {
    const std::vector<float> map = flip_map(a, b, kPixelsPerDegree);
    for (const float value : map) EXPECT_NEAR(value, map[0], 2e-5);
    return static_cast<double>(map[0]);
  };
  EXPECT_NEAR(error(uniform(0, 0, 0), uniform(1, 1, 1)), remapped(100), 2e-5);
  EXPECT_NEAR(error(uniform(0, 1, 0), uniform(0, 0, 1)), 1, 2e-5);
  EXPECT_NEAR(error(uniform(1, 0, 0), uniform(1, 1, 1)), remapped(distance(kRed, kWhite)), 2e-5);
  EXPECT_NEAR(error(uniform(1, 0, 0), uniform(0, 0, 1)), remapped(distance(kRed, kBlue)), 2e-5);
  // L* of 50 and of 55 as sRGB: luminance ((L + 16) / 116)^3.
  const auto grey = [](double lightness) {
    const double value = 1.055 * std::pow((lightness + 16) / 116, 3 / 2.4) - 0.055;
    return uniform(value, value, value);
  };
  EXPECT_NEAR(error(grey(50), grey(55)), remapped(5), 2e-5);
}

TEST(Flip, EqualImagesDoNotDiffer) {
  const DisplayImage image =
      made_image(40, 30, [](int x, int y, int c) { return (x * 7 + y * 13 + c * 5) % 11 / 10.0; });
  for (const float value : flip_map(image, image, kPixelsPerDegree)) EXPECT_EQ(value, 0);
}

// A step from black to white against black, at the first white pixel. The edge detector's half sums to 1, so that the
// feature difference is 1 / sqrt(2); the point detector's stays below. The achromatic filter, a Gaussian of variance
// b / (2 pi^2), leaves half of the luminance and half of its middle tap.
TEST(Flip, AnEdgeSharpensTheColorDifference) {
  constexpr int kWidth = 80, kHeight = 3;
  const DisplayImage black = uniform(0, 0, 0, kWidth, kHeight);
  const DisplayImage step = made_image(kWidth, kHeight, [](int x, int, int) { return x >= kWidth / 2 ? 1 : 0; });
  const std::vector<float> map = flip_map(black, step, kPixelsPerDegree);

  const double deviation = std::sqrt(0.0047 / 2) / std::numbers::pi * kPixelsPerDegree;
  double sum = 0;
  for (int i = -10; i <= 10; ++i) sum += std::exp(-0.5 * i * i / (deviation * deviation));
  const double lightness = 116 * std::cbrt(0.5 + 0.5 / sum) - 16;
  const double expected = std::pow(remapped(lightness), 1 - std::sqrt(1 / std::numbers::sqrt2));
  EXPECT_NEAR(map[kWidth + kWidth / 2], expected, 2e-5);
  EXPECT_EQ(map[kWidth], 0);  // far from the edge black is black
  EXPECT_NEAR(map[kWidth + kWidth - 1], remapped(100), 2e-5);
}

// A bright line one pixel wide answers the point detector: against uniform black its middle has the normalized
// second derivative's middle tap, and no first derivative.
TEST(Flip, ALineIsAPointFeature) {
  constexpr int kWidth = 81, kHeight = 3;
  const DisplayImage black = uniform(0, 0, 0, kWidth, kHeight);
  const DisplayImage line = made_image(kWidth, kHeight, [](int x, int, int) { return x == kWidth / 2 ? 1 : 0; });
  const std::vector<float> map = flip_map(line, black, kPixelsPerDegree);

  const double deviation = 0.5 * 0.082 * kPixelsPerDegree;
  double negative = 0;
  for (int i = -9; i <= 9; ++i) {
    negative += std::max(0.0, (1 - i * i / (deviation * deviation)) * std::exp(-0.5 * i * i / (deviation * deviation)));
  }
  const double csf = std::sqrt(0.0047 / 2) / std::numbers::pi * kPixelsPerDegree;
  double sum = 0;
  for (int i = -10; i <= 10; ++i) sum += std::exp(-0.5 * i * i / (csf * csf));
  const double color = remapped(116 * std::cbrt(1 / sum) - 16);
  const double expected = std::pow(color, 1 - std::sqrt(1 / negative / std::numbers::sqrt2));
  EXPECT_NEAR(map[kWidth + kWidth / 2], expected, 2e-5);
}

/// Equally distributed bytes, the same on every machine.
DisplayImage noise(int width, int height, std::uint32_t state) {
  return made_image(width, height, [&](int, int, int) {
    state = state * 1664525u + 1013904223u;
    return static_cast<float>(state >> 24) / 255.0f;
  });
}

TEST(Flip, OrderAndOrientationDoNotMatter) {
  constexpr int kWidth = 50, kHeight = 30;
  const DisplayImage a = noise(kWidth, kHeight, 1), b = noise(kWidth, kHeight, 2);
  const auto turned = [](const DisplayImage& image) {
    return made_image(kHeight, kWidth, [&](int x, int y, int c) { return image.planes[c][x * kWidth + y]; });
  };
  const auto map = flip_map(a, b, kPixelsPerDegree), swapped = flip_map(b, a, kPixelsPerDegree);
  const auto transposed = flip_map(turned(a), turned(b), kPixelsPerDegree);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(map[y * kWidth + x], swapped[y * kWidth + x]);
      EXPECT_NEAR(map[y * kWidth + x], transposed[x * kHeight + y], 1e-4);
    }
  }
}

// Values of the authors' own program, flip-evaluator 1.7, for the same two images. It computes in single precision.
TEST(Flip, AgreesWithTheAuthorsProgram) {
  constexpr int kWidth = 50, kHeight = 30;
  const struct {
    double pixels_per_degree, mean, first, middle, last;
  } expected[] = {{20, 0.84575956, 0.60619396, 0.96040440, 0.68320763},
                  {67, 0.43328328, 0.41400203, 0.43576860, 0.70709282}};
  for (const auto& [pixels_per_degree, mean, first, middle, last] : expected) {
    const auto map = flip_map(noise(kWidth, kHeight, 1), noise(kWidth, kHeight, 2), pixels_per_degree);
    double sum = 0;
    for (const float value : map) sum += value;
    EXPECT_NEAR(sum / (kWidth * kHeight), mean, 2e-5);
    EXPECT_NEAR(map.front(), first, 1e-4);
    EXPECT_NEAR(map[15 * kWidth + 25], middle, 1e-4);
    EXPECT_NEAR(map.back(), last, 1e-4);
  }
}

TEST(Flip, ErrorsStayBetweenZeroAndOne) {
  for (const double pixels_per_degree : {1.0, 20.0, 200.0, 1000.0}) {
    for (const float value : flip_map(noise(13, 1, 3), noise(13, 1, 4), pixels_per_degree)) {
      EXPECT_GE(value, 0);
      EXPECT_LE(value, 1);
    }
  }
}

}  // namespace
}  // namespace norrsken
