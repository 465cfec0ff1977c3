// conductor and roughconductor: their parameters, and what must come out of them.
#include "bsdf/conductor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/roughconductor.h"
#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

MaterialWord front_of(const Compiled& c) { return c.tables().surfaces.at(0).material_front; }

std::vector<float> parameters_of(const Compiled& c, std::ptrdiff_t count) {
  const auto first = c.tables().parameters.begin() + (front_of(c) & kMaterialOffsetMask);
  return {first, first + count};
}

Compiled compile(const std::string& plugin, const std::string& inside) {
  return compile_bsdf("<bsdf type=\"" + plugin + "\">" + inside + "</bsdf>");
}

TEST(ConductorHost, OfNoMaterialReflectsEverything) {
  for (const char* inside : {"", R"(<string name="material" value="none"/>)"}) {
    const Compiled c = compile("conductor", inside);
    ASSERT_THAT(c.messages(), IsEmpty());
    EXPECT_EQ(material_kind(front_of(c)), BsdfKind::conductor);
    EXPECT_EQ(c.tables().surfaces.at(0).material_back, make_material(BsdfKind::absorb, 0));
    EXPECT_THAT(parameters_of(c, 12), ElementsAre(1, 1, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0));
  }
}

TEST(ConductorHost, TakesASpecularReflectance) {
  const Compiled c = compile("conductor", R"(<rgb name="specular_reflectance" value="0.9, 0.8, 0.7"/>)");
  EXPECT_THAT(parameters_of(c, 3), ElementsAre(0.9f, 0.8f, 0.7f));
  EXPECT_THAT(compile("conductor", R"(<float name="specular_reflectance" value="2"/>)").messages(),
              ElementsAre("error: 'specular_reflectance' is (2, 2, 2) [components from 0 to 1]"));
  for (const char* plugin : {"conductor", "roughconductor"}) {
    const Compiled black = compile(plugin, R"(<float name="specular_reflectance" value="0"/>)");
    EXPECT_EQ(front_of(black), make_material(BsdfKind::absorb, 0));
  }
}

TEST(ConductorHost, KnowsMetals) {
  // Within a thousandth of what Mitsuba 3.9 makes of the same curves when it renders in RGB.
  const struct {
    const char* name;
    float eta[3], k[3];
  } metals[] = {{"Al", {1.6575f, 0.880405f, 0.521244f}, {9.22381f, 6.2695f, 4.837f}},
                {"a-C", {2.94405f, 2.22714f, 1.96816f}, {0.887465f, 0.799299f, 0.81529f}},
                {"Au", {0.143036f, 0.375307f, 1.44205f}, {3.983f, 2.38556f, 1.60336f}}};
  for (const auto& metal : metals) {
    const Compiled c = compile("conductor", "<string name=\"material\" value=\"" + std::string(metal.name) + "\"/>");
    ASSERT_THAT(c.messages(), IsEmpty());
    const std::vector<float> stored = parameters_of(c, 12);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(stored[4 + i], metal.eta[i], 1e-3f * metal.eta[i]) << metal.name;
      EXPECT_NEAR(stored[8 + i], metal.k[i], 1e-3f * metal.k[i]) << metal.name;
    }
  }
}

TEST(ConductorHost, RefusesOtherMaterials) {
  EXPECT_THAT(compile("conductor", R"(<string name="material" value="Aul"/>)").messages(),
              ElementsAre(::testing::AllOf(HasSubstr("error: 'material' is 'Aul', did you mean 'Al'?"),
                                           HasSubstr("[none, a-C, Ag, Al, "))));
  EXPECT_THAT(compile("conductor", R"(<float name="material" value="1"/>)").messages(),
              ElementsAre("error: 'material' is a float [string]"));
}

TEST(ConductorHost, TakesAnIndexOrAMaterial) {
  const Compiled c = compile("conductor", R"(<rgb name="eta" value="0.2, 0.9, 1.1"/><float name="k" value="3.9"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(parameters_of(c, 12), ElementsAre(1, 1, 1, 0, 0.2f, 0.9f, 1.1f, 0, 3.9f, 3.9f, 3.9f, 0));
  EXPECT_THAT(compile("conductor", R"(<string name="material" value="Au"/><float name="k" value="3"/>)").messages(),
              ElementsAre("error: 'k' is given next to material 'Au' [a material, or eta and k]"));
  EXPECT_THAT(compile("conductor", R"(<float name="eta" value="-1"/>)").messages(),
              ElementsAre(HasSubstr("error: 'eta' is (-1, -1, -1)")));
  EXPECT_THAT(compile("conductor", R"(<string name="k" value="3"/>)").messages(),
              ElementsAre("error: 'k' is a string [rgb, spectrum, float]"));
}

TEST(ConductorHost, RefusesUnknownParameters) {
  EXPECT_THAT(compile("conductor", R"(<float name="alpha" value="0.1"/>)").messages(),
              ElementsAre(HasSubstr("error: unused parameter 'alpha' of bsdf 'conductor'")));
  EXPECT_THAT(
      compile("roughconductor", R"(<float name="alpah" value="0.1"/>)").messages(),
      ElementsAre(HasSubstr(
          "unused parameter 'alpah' of bsdf 'roughconductor', did you mean 'alpha'? [alpha, alpha_u, alpha_v, ")));
}

TEST(RoughconductorHost, StoresItsRoughness) {
  const Compiled c = compile("roughconductor", "");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front_of(c)), BsdfKind::roughconductor);
  EXPECT_THAT(parameters_of(c, 17), ElementsAre(1, 1, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0.1f, 0, 0.1f, 0, 0));
  EXPECT_FALSE(c.tables().needs_uv);

  const Compiled along = compile("roughconductor", R"(<string name="distribution" value="GGX"/>
      <float name="alpha_u" value="0.3"/><float name="alpha_v" value="0.2"/>
      <boolean name="sample_visible" value="false"/>)");
  ASSERT_THAT(along.messages(), IsEmpty());
  const std::vector<float> stored = parameters_of(along, 17);
  EXPECT_THAT(std::vector<float>(stored.begin() + 12, stored.end()), ElementsAre(0.3f, 0, 0.2f, 0, 1));
  EXPECT_TRUE(along.tables().needs_uv);  // for the directions of u and v
}

TEST(RoughconductorHost, RefusesRoughnessThatContradictsItself) {
  const std::string accepted = " [alpha, or both of alpha_u and alpha_v]";
  EXPECT_THAT(compile("roughconductor", R"(<float name="alpha_u" value="0.3"/>)").messages(),
              ElementsAre("error: 'alpha_u' is given without 'alpha_v'" + accepted));
  EXPECT_THAT(compile("roughconductor", R"(<float name="alpha_v" value="0.3"/>)").messages(),
              ElementsAre("error: 'alpha_v' is given without 'alpha_u'" + accepted));
  EXPECT_THAT(compile("roughconductor", R"(<float name="alpha" value="0.3"/><float name="alpha_u" value="0.3"/>
                                           <float name="alpha_v" value="0.3"/>)")
                  .messages(),
              ElementsAre("error: 'alpha' is given next to 'alpha_u' or 'alpha_v'" + accepted));
}

TEST(RoughconductorHost, RefusesWrongValues) {
  EXPECT_THAT(compile("roughconductor", R"(<float name="alpha" value="-0.1"/>)").messages(),
              ElementsAre("error: 'alpha' is -0.1 [a number from 0 to 100]"));
  EXPECT_THAT(compile("roughconductor", R"(<string name="alpha" value="rough"/>)").messages(),
              ElementsAre(HasSubstr("error: 'alpha' is a string")));
  EXPECT_THAT(compile("roughconductor", R"(<string name="distribution" value="bekmann"/>)").messages(),
              ElementsAre("error: 'distribution' is 'bekmann', did you mean 'beckmann'? [beckmann, ggx]"));
  EXPECT_THAT(compile("roughconductor", R"(<float name="distribution" value="1"/>)").messages(),
              ElementsAre("error: 'distribution' is a float [string: beckmann, ggx]"));
  EXPECT_THAT(compile("roughconductor", R"(<float name="sample_visible" value="1"/>)").messages(),
              ElementsAre("error: 'sample_visible' is a float [boolean]"));
}

// --- kernels, on one lane --------------------------------------------------------------------------------------------
using namespace isa_host;

template <class Model>
typename Model::Parameters load(const Compiled& c) {
  SceneView scene;
  scene.parameters = c.tables().parameters.data();
  return Model::load(ParameterReader{scene, UInt(front_of(c) & kMaterialOffsetMask), TexturePoint{}, Mask{true}});
}

/// ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2) of gold.
template <class Model>
void expect_gold_at_normal_incidence(const std::string& plugin, const std::string& parameters) {
  const auto gold = load<Model>(compile(plugin, R"(<string name="material" value="Au"/>)" + parameters));
  const Vec3f front{Float(0.0f), Float(0.0f), Float(1.0f)};
  const BsdfSample s = Model::sample(gold, front, Float(0.5f), {Float(0.5f), Float(0.5f)});
  const auto normal_incidence = [](double eta, double k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  };
  EXPECT_NEAR(double(s.weight.r.v), normal_incidence(0.143036, 3.983), 1e-3);
  EXPECT_NEAR(double(s.weight.b.v), normal_incidence(1.44205, 1.60336), 1e-3);
}

TEST(Conductor, HasTheReflectanceOfItsMetal) { expect_gold_at_normal_incidence<Conductor>("conductor", ""); }

TEST(RoughConductor, HasTheReflectanceOfItsMetal) {
  expect_gold_at_normal_incidence<RoughConductor>("roughconductor", R"(<float name="alpha" value="0.001"/>)");
}

/// Smoother and smoother facets give back all the light around the mirror's direction.
TEST(RoughConductor, TendsToTheMirror) {
  const Vec3f wo{Float(0.6f), Float(0.0f), Float(0.8f)};
  for (const char* distribution : {"beckmann", "ggx"}) {
    const auto smooth = load<RoughConductor>(
        compile("roughconductor", "<string name=\"distribution\" value=\"" + std::string(distribution) +
                                      R"("/><float name="alpha" value="0.001"/>)"));
    for (int i = 0; i < 100; ++i) {
      const BsdfSample s = RoughConductor::sample(smooth, wo, Float(0.0f), {Float(float(i) / 100), Float(0.5f)});
      ASSERT_TRUE(s.valid.v);
      EXPECT_NEAR(double(s.wi.x.v), -0.6, 0.05);
      EXPECT_NEAR(double(s.weight.g.v), 1.0, 1e-3);
    }
  }
}

}  // namespace
}  // namespace norrsken::testing
