// plastic and roughplastic: their parameters, and limits with a closed form.
#include "bsdf/plastic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bsdf/bsdf_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<float> parameters_of(const Compiled& c, std::ptrdiff_t count) {
  const auto first = c.tables().parameters.begin() + (c.tables().surfaces.at(0).material_front & kMaterialOffsetMask);
  return {first, first + count};
}
Compiled compile(const std::string& plugin, const std::string& inside) {
  return compile_bsdf("<bsdf type=\"" + plugin + "\">" + inside + "</bsdf>");
}

constexpr float kPolypropylene = 1.49f / 1.000277f;

TEST(PlasticHost, IsWhitePolypropyleneUnlessTold) {
  for (const char* plugin : {"plastic", "roughplastic"}) {
    const Compiled c = compile(plugin, "");
    ASSERT_THAT(c.messages(), IsEmpty());
    const std::vector<float> p = parameters_of(c, 12);
    EXPECT_THAT(std::vector<float>(p.begin(), p.begin() + 8), ElementsAre(.5f, .5f, .5f, 0, 1, 1, 1, 0));
    EXPECT_FLOAT_EQ(p[8], kPolypropylene);
    EXPECT_FLOAT_EQ(p[10], 2 / 3.0f);  // specular over specular and diffuse
    EXPECT_EQ(p[11], 0.0f);
    EXPECT_EQ(c.tables().surfaces.at(0).material_back, make_material(BsdfKind::absorb, 0));
  }
  // What Mitsuba 3.9 prints as fdr_int.
  EXPECT_NEAR(parameters_of(compile("plastic", ""), 12)[9], 0.590479f, 1e-6f);
}

TEST(PlasticHost, TakesItsParameters) {
  for (const char* plugin : {"plastic", "roughplastic"}) {
    const Compiled c = compile(plugin, R"(<rgb name="diffuse_reflectance" value="0.1, 0.2, 0.3"/>
      <rgb name="specular_reflectance" value="0.7, 0.6, 0.5"/><boolean name="nonlinear" value="true"/>
      <string name="int_ior" value="diamond"/><float name="ext_ior" value="1.2"/>)");
    ASSERT_THAT(c.messages(), IsEmpty());
    const std::vector<float> p = parameters_of(c, 12);
    EXPECT_THAT(std::vector<float>(p.begin(), p.begin() + 8), ElementsAre(.1f, .2f, .3f, 0, .7f, .6f, .5f, 0));
    EXPECT_FLOAT_EQ(p[8], 2.419f / 1.2f);
    EXPECT_FLOAT_EQ(p[10], 0.75f);
    EXPECT_EQ(p[11], 1.0f);
  }
}

TEST(PlasticHost, RefusesWhatIsWrong) {
  for (const char* plugin : {"plastic", "roughplastic"}) {
    const auto messages = [&](const char* inside) { return compile(plugin, inside).messages(); };
    for (const std::string name : {"diffuse_reflectance", "specular_reflectance"}) {
      EXPECT_THAT(messages(("<float name=\"" + name + "\" value=\"1.5\"/>").c_str()),
                  ElementsAre("error: '" + name + "' is (1.5, 1.5, 1.5) [components from 0 to 1]"));
      EXPECT_THAT(messages(("<string name=\"" + name + "\" value=\"red\"/>").c_str()),
                  ElementsAre(HasSubstr("error: '" + name + "' is a string")));
    }
    for (const std::string name : {"int_ior", "ext_ior"}) {
      EXPECT_THAT(messages(("<float name=\"" + name + "\" value=\"0\"/>").c_str()),
                  ElementsAre(HasSubstr("error: '" + name + "' is 0")));
      EXPECT_THAT(messages(("<string name=\"" + name + "\" value=\"watr\"/>").c_str()),
                  ElementsAre(HasSubstr("did you mean 'water'?")));
    }
    EXPECT_THAT(messages(R"(<float name="nonlinear" value="1"/>)"), ElementsAre(HasSubstr("'nonlinear' is a float")));
    EXPECT_THAT(messages(R"(<float name="diffuse_reflectence" value="1"/>)"),
                ElementsAre(HasSubstr("did you mean 'diffuse_reflectance'?")));
  }
  EXPECT_THAT(compile("plastic", R"(<float name="alpha" value="0.1"/>)").messages(),
              ElementsAre(HasSubstr("error: unused parameter 'alpha' of bsdf 'plastic'")));
}

TEST(RoughPlasticHost, TakesItsRoughness) {
  const Compiled c = compile("roughplastic", R"(<string name="distribution" value="ggx"/>
    <float name="alpha" value="0.25"/><boolean name="sample_visible" value="false"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(parameters_of(c, 14)[12], 0.25f);
  EXPECT_EQ(parameters_of(c, 14)[13], 1.0f);
  EXPECT_EQ(parameters_of(compile("roughplastic", ""), 14)[12], 0.1f);
  EXPECT_EQ(parameters_of(compile("roughplastic", ""), 14)[13], 0.0f);
  EXPECT_EQ(parameters_of(compile("roughplastic", R"(<float name="alpha" value="0"/>)"), 14)[12], 1e-4f);
}

TEST(RoughPlasticHost, RefusesWhatIsWrong) {
  const auto messages = [](const char* inside) { return compile("roughplastic", inside).messages(); };
  EXPECT_THAT(messages(R"(<float name="alpha" value="-1"/>)"), ElementsAre(HasSubstr("error: 'alpha' is -1")));
  EXPECT_THAT(messages(R"(<string name="alpha" value="rough"/>)"),
              ElementsAre(HasSubstr("error: 'alpha' is a string")));
  EXPECT_THAT(messages(R"(<string name="distribution" value="phong"/>)"),
              ElementsAre(HasSubstr("error: 'distribution' is 'phong'")));
  EXPECT_THAT(messages(R"(<float name="alpha_u" value="0.1"/>)"),
              ElementsAre(HasSubstr("error: bsdf 'roughplastic' has one roughness")));
  EXPECT_THAT(
      messages(R"(<float name="int_ior" value="1.3"/><float name="ext_ior" value="1.3"/>)"),
      ElementsAre("error: the indices of refraction of both sides are the same [int_ior and ext_ior that differ]"));
}

using isa_host::Float;
using isa_host::Vec3f;

/// Without a difference in index there is no coat, and the base is Lambert's but for the fit of what comes back.
TEST(Plastic, WithoutACoatIsDiffuse) {
  const auto sides =
      isa_host::load_bsdf("plastic", R"(<float name="int_ior" value="1.3"/><float name="ext_ior" value="1.3"/>
                    <rgb name="diffuse_reflectance" value="0.8, 0.5, 0.3"/>)");
  const Vec3f wo{Float(0.6f), Float(0.0f), Float(0.8f)}, wi{Float(0.0f), Float(-0.8f), Float(0.6f)};
  EXPECT_NEAR(sides.front->evaluate(wo, wi).r.v, 0.8f * 0.6f / float(M_PI), 4e-5f);
}

/// With a base that gives everything back and colours it again each time, no light is lost.
TEST(Plastic, WhiteGivesEverythingBack) {
  const auto sides = isa_host::load_bsdf(
      "plastic", R"(<boolean name="nonlinear" value="true"/><float name="diffuse_reflectance" value="1"/>)");
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  constexpr int kSamples = 200'000;
  for (const float cos_o : {1.0f, 0.6f, 0.28f}) {
    const Vec3f wo{Float(std::sqrt(1 - cos_o * cos_o)), Float(0.0f), Float(cos_o)};
    double sum = 0;
    for (int i = 0; i < kSamples; ++i) {
      const float lobe = unit(random), x = unit(random), y = unit(random);
      sum += double(sides.front->sample(wo, lobe, {Float(x), Float(y)}).weight.r.v) / kSamples;
    }
    EXPECT_NEAR(sum, 1.0, 3e-3) << cos_o;
  }
}

/// The rough coat's table tends to Fresnel's factors as the roughness goes.
TEST(RoughPlastic, OfLittleRoughnessLetsAsMuchInAsSmoothPlastic) {
  const auto rough = isa_host::load_bsdf("roughplastic", R"(<float name="alpha" value="0.001"/>)");
  const auto smooth = isa_host::load_bsdf("plastic", "");
  const Vec3f wo{Float(0.6f), Float(0.0f), Float(0.8f)}, wi{Float(0.0f), Float(-0.8f), Float(0.6f)};
  EXPECT_NEAR(rough.front->evaluate(wo, wi).r.v / smooth.front->evaluate(wo, wi).r.v, 1.0, 0.03);
}

}  // namespace
}  // namespace norrsken::testing
