// dielectric, thindielectric and roughdielectric: their parameters, and what must come out of them.
#include "bsdf/dielectric.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/roughdielectric.h"
#include "bsdf/thindielectric.h"
#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr float kBk7 = 1.5046f / 1.000277f;

std::vector<float> parameters_of(const Compiled& c, MaterialWord word, std::ptrdiff_t count) {
  const auto first = c.tables().parameters.begin() + (word & kMaterialOffsetMask);
  return {first, first + count};
}
MaterialWord front_of(const Compiled& c) { return c.tables().surfaces.at(0).material_front; }
MaterialWord back_of(const Compiled& c) { return c.tables().surfaces.at(0).material_back; }

Compiled compile(const std::string& plugin, const std::string& inside) {
  return compile_bsdf("<bsdf type=\"" + plugin + "\">" + inside + "</bsdf>");
}

TEST(DielectricHost, IsGlassInAirUnlessTold) {
  const Compiled c = compile("dielectric", "");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front_of(c)), BsdfKind::dielectric);
  EXPECT_EQ(material_kind(back_of(c)), BsdfKind::dielectric);
  EXPECT_THAT(parameters_of(c, front_of(c), 9), ElementsAre(1, 1, 1, 0, 1, 1, 1, 0, ::testing::FloatEq(kBk7)));
  EXPECT_FLOAT_EQ(parameters_of(c, back_of(c), 9)[8], 1 / kBk7);  // from inside the other way round
}

TEST(DielectricHost, TakesIndicesByNumberOrName) {
  const auto eta_of = [](const std::string& inside) {
    const Compiled c = compile("dielectric", inside);
    EXPECT_THAT(c.messages(), IsEmpty());
    return parameters_of(c, front_of(c), 9)[8];
  };
  EXPECT_FLOAT_EQ(eta_of(R"(<float name="int_ior" value="1.8"/><float name="ext_ior" value="1.2"/>)"), 1.5f);
  EXPECT_FLOAT_EQ(eta_of(R"(<string name="int_ior" value="Diamond"/><string name="ext_ior" value="vacuum"/>)"), 2.419f);
  EXPECT_FLOAT_EQ(eta_of(R"(<string name="ext_ior" value="water"/><integer name="int_ior" value="2"/>)"), 2 / 1.333f);
  EXPECT_FLOAT_EQ(eta_of(R"(<string name="int_ior" value="carbon tetrachloride"/><float name="ext_ior" value="1"/>)"),
                  1.461f);
}

TEST(DielectricHost, RefusesWrongIndices) {
  EXPECT_THAT(compile("dielectric", R"(<string name="int_ior" value="glas"/>)").messages(),
              ElementsAre(HasSubstr("error: 'int_ior' is 'glas' [a number, or vacuum, helium, ")));
  EXPECT_THAT(compile("dielectric", R"(<string name="ext_ior" value="watr"/>)").messages(),
              ElementsAre(HasSubstr("error: 'ext_ior' is 'watr', did you mean 'water'?")));
  EXPECT_THAT(compile("dielectric", R"(<float name="int_ior" value="0"/>)").messages(),
              ElementsAre(HasSubstr("error: 'int_ior' is 0 [")));
  EXPECT_THAT(compile("dielectric", R"(<float name="ext_ior" value="-1"/>)").messages(),
              ElementsAre(HasSubstr("error: 'ext_ior' is -1 [")));
  EXPECT_THAT(compile("dielectric", R"(<boolean name="int_ior" value="true"/>)").messages(),
              ElementsAre(HasSubstr("error: 'int_ior' is a boolean")));
}

TEST(DielectricHost, TakesFactors) {
  for (const char* plugin : {"dielectric", "thindielectric", "roughdielectric"}) {
    const Compiled c = compile(plugin, R"(<rgb name="specular_reflectance" value="0.1, 0.2, 0.3"/>
                                          <float name="specular_transmittance" value="0.5"/>)");
    ASSERT_THAT(c.messages(), IsEmpty());
    EXPECT_THAT(parameters_of(c, front_of(c), 8), ElementsAre(0.1f, 0.2f, 0.3f, 0, 0.5f, 0.5f, 0.5f, 0)) << plugin;
    EXPECT_THAT(compile(plugin, R"(<float name="specular_reflectance" value="1.5"/>)").messages(),
                ElementsAre("error: 'specular_reflectance' is (1.5, 1.5, 1.5) [components from 0 to 1]"));
    EXPECT_THAT(compile(plugin, R"(<string name="specular_transmittance" value="red"/>)").messages(),
                ElementsAre("error: 'specular_transmittance' is a string [rgb, spectrum, float]"));
    EXPECT_THAT(compile(plugin, R"(<float name="ior" value="1.5"/>)").messages(),
                ElementsAre(HasSubstr("error: unused parameter 'ior' of bsdf '" + std::string(plugin))));
  }
}

TEST(ThindielectricHost, IsTheSameFromBothSides) {
  const Compiled c = compile("thindielectric", R"(<float name="int_ior" value="1.33"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front_of(c)), BsdfKind::thindielectric);
  EXPECT_EQ(front_of(c), back_of(c));
  EXPECT_FLOAT_EQ(parameters_of(c, front_of(c), 9)[8], 1.33f / 1.000277f);
}

TEST(RoughdielectricHost, StoresItsRoughness) {
  const Compiled c = compile("roughdielectric", R"(<string name="distribution" value="ggx"/>
      <float name="alpha" value="0.25"/><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front_of(c)), BsdfKind::roughdielectric);
  EXPECT_THAT(parameters_of(c, front_of(c), 14), ElementsAre(1, 1, 1, 0, 1, 1, 1, 0, 0.25f, 0, 0.25f, 0, 1, 1.5f));
  EXPECT_FLOAT_EQ(parameters_of(c, back_of(c), 14)[13], 1 / 1.5f);
  EXPECT_THAT(compile("roughdielectric", R"(<float name="alpha" value="1e9"/>)").messages(),
              ElementsAre(HasSubstr("error: 'alpha' is 1000000000 [")));
}

TEST(RoughdielectricHost, NeedsAnInterface) {
  EXPECT_THAT(compile("roughdielectric", R"(<string name="int_ior" value="air"/>)").messages(),
              ElementsAre("error: the indices of refraction of both sides are the same "
                          "[int_ior and ext_ior that differ]"));
}

// --- kernels, on one lane --------------------------------------------------------------------------------------------
using namespace isa_host;

template <class Model>
typename Model::Parameters load(const Compiled& c, MaterialWord word) {
  SceneView scene;
  scene.parameters = c.tables().parameters.data();
  return Model::load(ParameterReader{scene, UInt(word & kMaterialOffsetMask), TexturePoint{}, Mask{true}});
}
constexpr char kGlass[] = R"(<float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>)";

TEST(Dielectric, GoesInAndOutAgainUnchanged) {
  const Compiled c = compile("dielectric", kGlass);
  const auto outside = load<Dielectric>(c, front_of(c)), inside = load<Dielectric>(c, back_of(c));
  const Vec3f wo{Float(0.6f), Float(0.0f), Float(0.8f)};
  const BsdfSample in = Dielectric::sample(outside, wo, Float(0.999f), {Float(0.5f), Float(0.5f)});
  ASSERT_TRUE(in.valid.v);
  EXPECT_NEAR(double(in.wi.x.v), -0.4, 1e-6);  // Snell
  EXPECT_LT(in.wi.z.v, 0.0f);
  EXPECT_EQ(in.eta.v, 1.5f);
  EXPECT_NEAR(double(in.weight.r.v), 1 / 2.25, 1e-6);
  // From inside, z points back into the glass.
  const Vec3f back{-in.wi.x, in.wi.y, -in.wi.z};
  const BsdfSample out = Dielectric::sample(inside, back, Float(0.999f), {Float(0.5f), Float(0.5f)});
  EXPECT_NEAR(double(out.wi.x.v), -0.6, 1e-6);
  EXPECT_NEAR(double(out.wi.z.v), -0.8, 1e-6);
  EXPECT_NEAR(double(out.eta.v) * double(in.eta.v), 1.0, 1e-6);
  EXPECT_NEAR(double(out.weight.r.v) * double(in.weight.r.v), 1.0, 1e-6);
}

TEST(Dielectric, ChoosesByFresnelsShares) {
  const Compiled c = compile("dielectric", kGlass);
  const auto glass = load<Dielectric>(c, front_of(c)), inside = load<Dielectric>(c, back_of(c));
  const Vec3f head_on{Float(0.0f), Float(0.0f), Float(1.0f)}, flat{Float(0.8f), Float(0.0f), Float(0.6f)};
  EXPECT_GT(Dielectric::sample(glass, head_on, Float(0.0399f), {}).wi.z.v, 0.0f);
  EXPECT_LT(Dielectric::sample(glass, head_on, Float(0.0401f), {}).wi.z.v, 0.0f);
  const BsdfSample total = Dielectric::sample(inside, flat, Float(0.9999f), {});
  EXPECT_GT(total.wi.z.v, 0.0f);
  EXPECT_EQ(total.weight.r.v, 1.0f);
}

TEST(ThinDielectric, GoesStraightOnAfterAnyNumberOfReflections) {
  const Compiled c = compile("thindielectric", kGlass);
  const auto pane = load<ThinDielectric>(c, front_of(c));
  const Vec3f wo{Float(0.6f), Float(0.0f), Float(0.8f)}, head_on{Float(0.0f), Float(0.0f), Float(1.0f)};
  const BsdfSample s = ThinDielectric::sample(pane, wo, Float(0.999f), {});
  EXPECT_EQ(s.wi.x.v, -wo.x.v);
  EXPECT_EQ(s.wi.z.v, -wo.z.v);
  EXPECT_EQ(s.eta.v, 1.0f);
  EXPECT_EQ(s.weight.r.v, 1.0f);
  // r = 0.04: the sum of r + t r t + t r^3 t + ...
  double sum = 0.04;
  for (int k = 1; k < 20; k += 2) sum += 0.96 * 0.96 * std::pow(0.04, k);
  EXPECT_GT(ThinDielectric::sample(pane, head_on, Float(float(sum - 1e-5)), {}).wi.z.v, 0.0f);
  EXPECT_LT(ThinDielectric::sample(pane, head_on, Float(float(sum + 1e-5)), {}).wi.z.v, 0.0f);
}

/// Smoother and smoother facets refract as the smooth interface does.
TEST(RoughDielectric, TendsToTheSmoothInterface) {
  for (const char* distribution : {"beckmann", "ggx"}) {
    const Compiled c =
        compile("roughdielectric", kGlass + ("<string name=\"distribution\" value=\"" + std::string(distribution) +
                                             R"("/><float name="alpha" value="0.001"/>)"));
    const auto glass = load<RoughDielectric>(c, front_of(c));
    const Vec3f wo{Float(0.6f), Float(0.0f), Float(0.8f)};
    const double reflected = double(fresnel_dielectric(Float(0.8f), Float(1.5f)).reflectance.v);
    for (const double side : {-0.01, 0.01}) {
      const BsdfSample s =
          RoughDielectric::sample(glass, wo, Float(float(reflected + side)), {Float(0.3f), Float(0.4f)});
      ASSERT_TRUE(s.valid.v);
      EXPECT_NEAR(double(s.wi.x.v), side < 0 ? -0.6 : -0.4, 0.01);
      EXPECT_EQ(s.wi.z.v > 0, side < 0);
      EXPECT_NEAR(double(s.weight.r.v), side < 0 ? 1.0 : 1 / 2.25, 1e-3);
      EXPECT_EQ(s.eta.v, side < 0 ? 1.0f : 1.5f);
    }
  }
}

}  // namespace
}  // namespace norrsken::testing
