// Every model of lists/bsdf.def: sampled directions against the density, weights against values, and how much light comes back.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bsdf/every_bsdf_testing.h"
#include "tests/statistics/statistical_test.h"
#include "tests/statistics/suite.h"

namespace norrsken::isa_host {
namespace {

using statistics::StatisticalTest;

constexpr int kViewCount = int(std::size(kViews));

TEST_P(EveryBsdf, DirectionsFollowTheDensity) {
  StatisticalTest test;
  on_each_side([&](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    if (bsdf.is_delta()) return test.skip(kViewCount * statistics::kPerDensity);  // see DiscreteDirections...
    for (const View& view : kViews) {
      const auto sampling = statistics::sampling_of_directions(
          [&](Random& random) -> std::optional<statistics::Direction> {
            const BsdfSample s = sample(bsdf, view.wo, random);
            return s.valid.v && s.pdf_sa.v > 0 ? std::optional(components(s.wi)) : std::nullopt;
          },
          [&](const statistics::Direction& wi) { return double{bsdf.pdf_sa(view.wo, lanes(wi))}; });
      EXPECT_TRUE(test.follows_density(sampling, configuration(bsdf, view)));
    }
  });
  if (!has_back()) test.skip(kViewCount * statistics::kPerDensity);
}

/// The share of the light that comes back by way of samples, and what evaluate() and the discrete directions say it is.
/// Beyond an interface surroundings of radiance 1 have eta^2.
struct Albedo {
  std::array<statistics::Estimate, 3> sampled;
  std::array<double, 3> evaluated{};
};
Albedo albedo(const LoadedBsdf& bsdf, const Vec3f& wo) {
  constexpr int kSamples = 100'000, kPilots = 20'000;
  std::array<statistics::Mean, 3> means;
  std::vector<statistics::Point> pilots;
  Albedo result;
  Random random(3);
  for (int i = 0; i < kSamples; ++i) {
    const BsdfSample s = sample(bsdf, wo, random);
    const auto weight = components(s.weight);
    const double factor = double{s.eta.v} * double{s.eta.v};
    for (std::size_t k = 0; k < 3; ++k) means[k].add(s.valid.v ? weight[k] * factor : 0);
    if (s.valid.v && s.pdf_sa.v > 0 && i < kPilots) pilots.push_back(statistics::sphere_point(components(s.wi)));
  }
  for (std::size_t k = 0; k < 3; ++k) result.sampled[k] = means[k].estimate();

  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const BsdfSample s = bsdf.sample(wo, (static_cast<float>(i) + 0.5f) / kSteps, {Float(0.4f), Float(0.3f)});
    if (!s.valid.v || s.pdf_sa.v != 0) continue;
    const double factor = double{s.eta.v} * double{s.eta.v} / kSteps;
    for (std::size_t k = 0; k < 3; ++k) result.evaluated[k] += components(s.weight)[k] * factor;
  }
  const double eta2 = double{bsdf.refracted_eta()} * double{bsdf.refracted_eta()};
  statistics::Partition partition(statistics::kSphere, std::move(pilots));
  for (std::size_t k = 0; k < 3 && !bsdf.is_delta(); ++k) {
    const auto value = [&](const statistics::Point& p) {
      const auto wi = statistics::sphere_direction(p);
      const double f = components(bsdf.evaluate(wo, lanes(wi)))[k];
      return 4 * M_PI * std::abs(p[1]) * f * (wi[2] < 0 ? eta2 : 1);
    };
    partition.for_each([&](const statistics::Cell& c, std::span<const statistics::Point> there) {
      result.evaluated[k] += statistics::integrate(value, c.bounds, there, result.sampled[k].mean / kPilots);
    });
  }
  return result;
}

TEST_P(EveryBsdf, WeightsAddUpToTheIntegralOfTheValueAndNoMoreThanArrives) {
  StatisticalTest test;
  on_each_side([&](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    for (const View& view : kViews) {
      const Albedo back = albedo(bsdf, view.wo);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_TRUE(
            test.agree(back.sampled[k], back.evaluated[k], configuration(bsdf, view), statistics::kQuadratureError))
            << "channel " << k;
        EXPECT_GT(back.evaluated[k], 0) << "channel " << k;
        EXPECT_LE(back.evaluated[k], GetParam().most * (1 + statistics::kQuadratureError)) << "channel " << k;
      }
    }
  });
  if (!has_back()) test.skip(3 * kViewCount);
}

TEST_P(WhiteFurnace, ReturnsWhatItSays) {
  StatisticalTest test;
  on_each_side([&](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    for (const View& view : kViews) {
      const Albedo back = albedo(bsdf, view.wo);
      EXPECT_TRUE(
          test.agree(back.sampled[1], back.evaluated[1], configuration(bsdf, view), statistics::kQuadratureError));
      EXPECT_LE(back.evaluated[1], GetParam().most + statistics::kQuadratureError) << configuration(bsdf, view);
      EXPECT_GE(back.evaluated[1], GetParam().least - statistics::kQuadratureError) << configuration(bsdf, view);
    }
  });
  if (!has_back()) test.skip(kViewCount);
}

}  // namespace
}  // namespace norrsken::isa_host
