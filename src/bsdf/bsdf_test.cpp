// Every model of lists/bsdf.def under every set of parameters of bsdf_test_cases.def: what holds sample by sample.
// bsdf_sampling_test.cpp has what holds on average.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "bsdf/every_bsdf_testing.h"

namespace norrsken::isa_host {
namespace {

TEST_P(EveryBsdf, WeightIsValueOverDensity) {
  on_each_side([](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    for (const View& view : kViews) {
      SCOPED_TRACE(view.name);
      Random random(1);
      for (int i = 0; i < 10'000; ++i) {
        const BsdfSample s = sample(bsdf, view.wo, random);
        if (!s.valid.v) continue;
        ASSERT_NEAR(double(dot(s.wi, s.wi).v), 1.0, 1e-4);
        ASSERT_GT(s.eta.v, 0.0f);
        if (s.wi.z.v > 0) {
          ASSERT_EQ(s.eta.v, 1.0f);
        }
        if (bsdf.is_delta()) {
          ASSERT_EQ(s.pdf_sa.v, 0.0f);
        }
        if (s.pdf_sa.v == 0) continue;
        const double pdf = double(bsdf.pdf_sa(view.wo, s.wi));
        ASSERT_NEAR(double(s.pdf_sa.v), pdf, 3e-3 * pdf + 1e-6) << "wi.z " << s.wi.z.v;
        const auto value = components(bsdf.evaluate(view.wo, s.wi)), weight = components(s.weight);
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_GE(weight[k], 0.0);
          ASSERT_NEAR(weight[k] * pdf, value[k], 3e-3 * value[k] + 1e-6) << "channel " << k << ", wi.z " << s.wi.z.v;
        }
      }
    }
  });
}

/// Rays carry it only where one of the models listed occurs.
TEST_P(EveryBsdf, TellsOfAnEtaIfItIsListed) {
  on_each_side([&](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    Random random(3);
    for (int i = 0; i < 1000 && !is_listed_as_refracting(); ++i) {
      const BsdfSample s = sample(bsdf, kViews[1].wo, random);
      ASSERT_TRUE(!s.valid.v || s.eta.v == 1.0f);
    }
  });
}

TEST_P(EveryBsdf, NothingIsScatteredFromBelow) {
  if (GetParam().plugin == "null") return;  // it knows no below: what it is put on may have normals
  on_each_side([](const LoadedBsdf& bsdf, const LoadedBsdf*) {
    Random random(2);
    for (const View& view : kViews) {
      SCOPED_TRACE(view.name);
      for (const Vec3f& wo : {other_side(view.wo), Vec3f{Float(0.6f), Float(0.8f), Float(0.0f)}}) {
        for (int i = 0; i < 100; ++i) {
          EXPECT_FALSE(sample(bsdf, wo, random).valid.v);
          const Vec3f wi = direction(2 * double(random()) - 1, 2 * M_PI * double(random()));
          EXPECT_EQ(components(bsdf.evaluate(wo, wi)), (std::array<double, 3>{}));
          EXPECT_EQ(bsdf.pdf_sa(wo, wi), 0.0f);
        }
      }
    }
  });
}

/// Radiance changes by the square of the indices' ratio as it crosses: Veach 1997, equation 5.14.
TEST_P(EveryBsdf, Reciprocity) {
  double most_one_way = 0;
  on_each_side([&](const LoadedBsdf& bsdf, const LoadedBsdf* beyond) {
    Random random(4);
    int pairs = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3f wo = direction(0.05 + 0.95 * double(random()), 2 * M_PI * double(random()));
      const BsdfSample s = sample(bsdf, wo, random);
      if (!s.valid.v || s.pdf_sa.v == 0 || std::abs(s.wi.z.v) < 0.05f) continue;
      const bool crosses = s.wi.z.v < 0;
      ++pairs;
      ASSERT_TRUE(!crosses || beyond) << "light comes from a side that scatters none";
      const auto there = components(bsdf.evaluate(wo, s.wi));
      const auto back =
          components(crosses ? beyond->evaluate(other_side(s.wi), other_side(wo)) : bsdf.evaluate(s.wi, wo));
      for (std::size_t k = 0; k < 3; ++k) {
        // evaluate() includes the cosine of its second direction.
        const double a = there[k] / std::abs(double(s.wi.z.v)) * double(s.eta.v) * double(s.eta.v);
        const double b = back[k] / double(wo.z.v);
        if ((crosses || GetParam().also_reflected) && !GetParam().one_way_because.empty()) {
          most_one_way = std::max(most_one_way, std::abs(a - b) / std::max({a, b, 1e-3}));
          continue;
        }
        ASSERT_NEAR(a, b, 3e-3 * std::max(a, b) + 1e-5)
            << "channel " << k << ", wo.z " << wo.z.v << ", wi.z " << s.wi.z.v << ", eta " << s.eta.v;
      }
    }
    EXPECT_TRUE(pairs > 500 || bsdf.is_delta());
  });
  if (!GetParam().one_way_because.empty()) {
    EXPECT_GT(most_one_way, 0.1) << "it is reciprocal, though it is said not to be because "
                                 << GetParam().one_way_because;
  }
}

// --- what is discrete: mirrors, and what is bent or passes straight on ------------------------------------------------

/// The one reflected and the one transmitted direction that have a probability, and the share of the light that comes from
/// there.
struct Discrete {
  Vec3f wi{};
  double eta = 1, prob = 0;
  std::array<double, 3> share{};
};
struct DiscretePart {
  Discrete reflected, transmitted;
};

/// Through all values of what chooses a lobe, evenly, so that probabilities are exact to 1 / kSteps.
DiscretePart discrete_part(const LoadedBsdf& bsdf, const Vec3f& wo) {
  constexpr int kSteps = 20'000;
  DiscretePart part;
  for (int i = 0; i < kSteps; ++i) {
    const float other = std::fmod(static_cast<float>(i) * 0.618034f, 1.0f);
    const BsdfSample s = bsdf.sample(wo, (static_cast<float>(i) + 0.5f) / kSteps, {Float(other), Float(0.3f)});
    if (!s.valid.v || s.pdf_sa.v != 0) continue;
    Discrete& d = s.wi.z.v > 0 ? part.reflected : part.transmitted;
    if (d.prob == 0) d.wi = s.wi, d.eta = double{s.eta.v};
    EXPECT_EQ(components(s.wi), components(d.wi)) << "more than one direction on a side";
    EXPECT_EQ(double{s.eta.v}, d.eta);
    d.prob += 1.0 / kSteps;
    for (std::size_t k = 0; k < 3; ++k) d.share[k] += components(s.weight)[k] / kSteps;
  }
  return part;
}

TEST_P(EveryBsdf, DiscreteDirectionsAreMirroredOrRefractedAndReciprocal) {
  constexpr double kExact = 2e-4;
  on_each_side([&](const LoadedBsdf& bsdf, const LoadedBsdf* beyond) {
    for (const View& view : kViews) {
      SCOPED_TRACE(view.name);
      const Vec3f& wo = view.wo;
      const DiscretePart part = discrete_part(bsdf, wo);
      EXPECT_LE(part.reflected.prob + part.transmitted.prob, 1 + 1e-9);
      if (bsdf.is_delta()) {
        EXPECT_GT(part.reflected.prob + part.transmitted.prob, 0);
      }
      for (const bool crosses : {false, true}) {
        const Discrete& d = crosses ? part.transmitted : part.reflected;
        if (d.prob == 0) continue;
        // Snell's law; straight on if the ratio is one.
        EXPECT_NEAR(double{d.wi.x.v} * d.eta, -double{wo.x.v}, 1e-5);
        EXPECT_NEAR(double{d.wi.y.v} * d.eta, -double{wo.y.v}, 1e-5);
        EXPECT_NEAR(double(dot(d.wi, d.wi).v), 1, 1e-5);
        ASSERT_TRUE(!crosses || beyond || d.eta == 1) << "light comes from a side that scatters none";
        const LoadedBsdf& there = crosses && beyond ? *beyond : bsdf;
        const DiscretePart from_there = discrete_part(there, crosses ? other_side(d.wi) : d.wi);
        const Discrete& back = crosses ? from_there.transmitted : from_there.reflected;
        EXPECT_NEAR(back.eta * d.eta, 1, 1e-5);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(d.share[k] * d.eta * d.eta, back.share[k] * back.eta * back.eta, kExact) << "channel " << k;
        }
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Cases, EveryBsdf, ::testing::ValuesIn(kBsdfCaseTable), test_name);
INSTANTIATE_TEST_SUITE_P(Cases, WhiteFurnace, ::testing::ValuesIn(kFurnaceTable), test_name);

TEST(Conductor, ReflectsAboutTheNormal) {
  const LoadedSides sides = load_bsdf("conductor", R"(<rgb name="specular_reflectance" value="0.8, 0.5, 0.3"/>)");
  const Vec3f wo = direction(0.3, 1);
  const BsdfSample s = sides.front->sample(wo, 0.5f, {Float(0.5f), Float(0.5f)});
  EXPECT_EQ(components(s.wi), components(Vec3f{-wo.x, -wo.y, wo.z}));
  EXPECT_EQ(s.weight.g.v, 0.5f);
}

}  // namespace
}  // namespace norrsken::isa_host
