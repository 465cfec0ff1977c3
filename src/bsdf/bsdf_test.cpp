// Every model of list.def: what it samples against its density and its value. A new model is tested by being listed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "bsdf/conductor.h"
#include "bsdf/diffuse.h"

namespace norrsken::isa_host {
namespace {

constexpr double kPi2 = 2 * M_PI;
// Parameters that every model can be loaded from: the first four are a colour without a texture.
constexpr float kParameters[16] = {0.8f, 0.5f, 0.3f, 0.0f, 0.5f, 0.5f, 0.5f, 0.5f};

template <class Model>
typename Model::Parameters load_model(const float* parameters) {
  SceneView scene;
  scene.parameters = parameters;
  return Model::load(ParameterReader{scene, UInt(0u), TexturePoint{}, Mask{true}});
}

Vec3f direction(double cos_theta, double phi) {
  const double r = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(cos_theta)};
}

const Vec3f kViews[] = {direction(1, 0), direction(0.8, 1), direction(0.3, 4), direction(0.02, 2)};

template <class Model>
class EveryBsdf : public testing::Test {
 protected:
  const typename Model::Parameters bsdf = load_model<Model>(kParameters);
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> unit{0, 1};

  BsdfSample sample(const Vec3f& wo) {
    const Float lobe(static_cast<float>(unit(random)));
    return Model::sample(bsdf, wo, lobe,
                         {static_cast<float>(unit(random) * 0.9999999), static_cast<float>(unit(random) * 0.9999999)});
  }
};

using Models = testing::Types<
#define NORRSKEN_BSDF(kind, Model) Model,
#include "bsdf/list.def"
#undef NORRSKEN_BSDF
    void>;

/// testing::Types without the trailing void that ends the list above.
template <class>
struct DropVoid;
template <class... Ts>
struct DropVoid<testing::Types<Ts...>> {
  template <class Kept, class... Rest>
  struct Step;
  template <class... Kept>
  struct Step<testing::Types<Kept...>, void> {
    using type = testing::Types<Kept...>;
  };
  template <class... Kept, class Next, class... Rest>
  struct Step<testing::Types<Kept...>, Next, Rest...> : Step<testing::Types<Kept..., Next>, Rest...> {};
  using type = typename Step<testing::Types<>, Ts...>::type;
};

TYPED_TEST_SUITE(EveryBsdf, DropVoid<Models>::type);

TYPED_TEST(EveryBsdf, WeightIsValueOverDensity) {
  for (const Vec3f& wo : kViews) {
    for (int i = 0; i < 10'000; ++i) {
      const BsdfSample s = this->sample(wo);
      if (!s.valid.v) continue;
      EXPECT_NEAR(double(dot(s.wi, s.wi).v), 1.0, 1e-4);
      if (TypeParam::kDelta) {
        EXPECT_EQ(s.pdf_sa.v, 0.0f);
        continue;
      }
      const double pdf = double(TypeParam::pdf_sa(this->bsdf, wo, s.wi).v);
      EXPECT_NEAR(double(s.pdf_sa.v), pdf, 1e-4 * pdf + 1e-6);
      const double value = double(TypeParam::evaluate(this->bsdf, wo, s.wi).x.v);
      EXPECT_NEAR(double(s.weight.x.v) * pdf, value, 1e-4 * value + 1e-6);
    }
  }
}

TYPED_TEST(EveryBsdf, NothingIsScatteredFromBelow) {
  for (const Vec3f& wo : kViews) {
    const Vec3f below{wo.x, wo.y, -wo.z};
    EXPECT_FALSE(this->sample(below).valid.v);
    EXPECT_EQ(TypeParam::evaluate(this->bsdf, below, direction(0.5, 1)).x.v, 0.0f);
    EXPECT_EQ(TypeParam::evaluate(this->bsdf, wo, direction(-0.5, 1)).x.v, 0.0f);
  }
}

TYPED_TEST(EveryBsdf, ReflectsNoMoreThanArrives) {
  for (const Vec3f& wo : kViews) {
    double sum[3] = {};
    constexpr int kSamples = 20'000;
    for (int i = 0; i < kSamples; ++i) {
      const BsdfSample s = this->sample(wo);
      if (!s.valid.v) continue;
      sum[0] += double(s.weight.x.v) / kSamples, sum[1] += double(s.weight.y.v) / kSamples;
      sum[2] += double(s.weight.z.v) / kSamples;
    }
    for (const double reflected : sum) {
      EXPECT_GT(reflected, 0.0);
      EXPECT_LE(reflected, 1.0 + 1e-3);
    }
  }
}

/// Sampled directions against the density, over a grid of the sphere that is even in solid angle.
TYPED_TEST(EveryBsdf, DirectionsFollowTheDensity) {
  if (TypeParam::kDelta) GTEST_SKIP() << "a delta has no density";
  constexpr int kRows = 20, kColumns = 20, kSamples = 1'000'000, kInner = 16;
  for (const Vec3f& wo : kViews) {
    std::vector<double> observed(kRows * kColumns), expected(kRows * kColumns);
    double valid = 0;
    for (int i = 0; i < kSamples; ++i) {
      const BsdfSample s = this->sample(wo);
      if (!s.valid.v) continue;
      ++valid;
      const int row = std::clamp(int((double(s.wi.z.v) + 1) / 2 * kRows), 0, kRows - 1);
      const double turn = std::atan2(double(s.wi.y.v), double(s.wi.x.v)) / kPi2 + 0.5;
      ++observed[std::size_t(row * kColumns + std::clamp(int(turn * kColumns), 0, kColumns - 1))];
    }
    double integral = 0;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        double cell = 0;
        for (int i = 0; i < kInner; ++i) {
          for (int k = 0; k < kInner; ++k) {
            const double z = (row + (i + 0.5) / kInner) / kRows * 2 - 1;
            const double turn = (column + (k + 0.5) / kInner) / kColumns - 0.5;
            cell += double(TypeParam::pdf_sa(this->bsdf, wo, direction(z, turn * kPi2)).v);
          }
        }
        cell *= 4 * M_PI / (kRows * kColumns * kInner * kInner);
        integral += cell;
        expected[std::size_t(row * kColumns + column)] = cell * kSamples;
      }
    }
    EXPECT_NEAR(integral, valid / kSamples, 2e-3);
    double chi2 = 0;
    int cells = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
      if (expected[i] < 5) continue;
      chi2 += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
      ++cells;
    }
    const double n = cells - 1;
    const double z = (std::cbrt(chi2 / n) - (1 - 2 / (9 * n))) / std::sqrt(2 / (9 * n));
    EXPECT_LT(z, 4.0) << "chi2 " << chi2 << " of " << cells << " cells";
  }
}

TYPED_TEST(EveryBsdf, Reciprocity) {
  if (TypeParam::kDelta) GTEST_SKIP() << "a delta has no value to compare";
  for (int i = 0; i < 1000; ++i) {
    const Vec3f a = direction(0.05 + 0.95 * this->unit(this->random), kPi2 * this->unit(this->random));
    const Vec3f b = direction(0.05 + 0.95 * this->unit(this->random), kPi2 * this->unit(this->random));
    // evaluate() includes the cosine of its second direction.
    const double ab = double(TypeParam::evaluate(this->bsdf, a, b).y.v) / double(b.z.v);
    const double ba = double(TypeParam::evaluate(this->bsdf, b, a).y.v) / double(a.z.v);
    EXPECT_NEAR(ab, ba, 1e-4 * ab);
  }
}

TEST(Conductor, ReflectsAboutTheNormal) {
  const auto bsdf = load_model<Conductor>(kParameters);
  const Vec3f wo = direction(0.3, 1);
  const BsdfSample s = Conductor::sample(bsdf, wo, Float(0.5f), {Float(0.5f), Float(0.5f)});
  EXPECT_EQ(s.wi.x.v, -wo.x.v);
  EXPECT_EQ(s.wi.y.v, -wo.y.v);
  EXPECT_EQ(s.wi.z.v, wo.z.v);
  EXPECT_EQ(s.weight.y.v, kParameters[1]);
}

}  // namespace
}  // namespace norrsken::isa_host
