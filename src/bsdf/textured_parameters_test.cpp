// Every parameter that may be a texture, of every model.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bsdf/bsdf_testing.h"

namespace norrsken::isa_host {
namespace {

struct Textured {
  const char* plugin;
  const char* parameter;
  const char* inside;  ///< what else it takes for the parameter to matter
};

constexpr Textured kTextured[] = {
    {"diffuse", "reflectance", ""},
    {"conductor", "specular_reflectance", ""},
    {"roughconductor", "specular_reflectance", ""},
    {"roughconductor", "alpha", ""},
    {"roughconductor", "alpha_u", R"(<float name="alpha_v" value="0.2"/>)"},
    {"roughconductor", "alpha_v", R"(<float name="alpha_u" value="0.2"/>)"},
    {"dielectric", "specular_reflectance", ""},
    {"dielectric", "specular_transmittance", ""},
    {"thindielectric", "specular_reflectance", ""},
    {"thindielectric", "specular_transmittance", ""},
    {"roughdielectric", "specular_reflectance", ""},
    {"roughdielectric", "specular_transmittance", ""},
    {"roughdielectric", "alpha", ""},
    {"plastic", "diffuse_reflectance", ""},
    {"plastic", "specular_reflectance", ""},
    {"roughplastic", "diffuse_reflectance", ""},
    {"roughplastic", "specular_reflectance", ""},
    {"principled", "base_color", ""},
    {"principled", "roughness", ""},
    {"principled", "anisotropic", ""},
    {"principled", "metallic", ""},
    {"principled", "spec_trans", ""},
    {"principled", "spec_tint", R"(<rgb name="base_color" value="0.8, 0.5, 0.3"/>)"},
    {"principled", "sheen", ""},
    {"principled", "sheen_tint", R"(<rgb name="base_color" value="0.8, 0.5, 0.3"/><float name="sheen" value="1"/>)"},
    {"principled", "flatness", ""},
    {"principled", "clearcoat", ""},
    {"principled", "clearcoat_gloss", R"(<float name="clearcoat" value="1"/>)"},
    {"principledthin", "base_color", ""},
    {"principledthin", "roughness", ""},
    {"principledthin", "anisotropic", R"(<float name="spec_trans" value="0.5"/>)"},
    {"principledthin", "spec_trans", ""},
    {"principledthin", "spec_tint",
     R"(<rgb name="base_color" value="0.8, 0.5, 0.3"/><float name="spec_trans" value="0.5"/>)"},
    {"principledthin", "sheen", ""},
    {"principledthin", "sheen_tint",
     R"(<rgb name="base_color" value="0.8, 0.5, 0.3"/><float name="sheen" value="1"/>)"},
    {"principledthin", "flatness", ""},
    {"principledthin", "diff_trans", ""},
    {"principledthin", "eta", R"(<float name="spec_trans" value="0.5"/>)"},
};

/// Values and densities of random directions, and weights of samples.
std::vector<float> figures_of(const LoadedBsdf& bsdf) {
  std::vector<float> figures;
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto direction = [&](float lowest) {
    const float z = lowest + (0.95f - lowest) * unit(random), phi = 2 * float(M_PI) * unit(random);
    const float r = std::sqrt(1 - z * z);
    return Vec3f{Float(r * std::cos(phi)), Float(r * std::sin(phi)), Float(z)};
  };
  const auto add = [&](const Color& c) { figures.insert(figures.end(), {c.r.v, c.g.v, c.b.v}); };
  for (int i = 0; i < 100; ++i) {
    const Vec3f wo = direction(0.1f), wi = direction(-0.95f);
    add(bsdf.evaluate(wo, wi));
    figures.push_back(bsdf.pdf_sa(wo, wi));
    const float lobe = unit(random), x = unit(random), y = unit(random);
    const BsdfSample s = bsdf.sample(wo, lobe, {Float(x), Float(y)});
    add(s.valid.v ? s.weight : black());
  }
  return figures;
}

/// A texture stands for the value that it has where the surface is hit, and a parameter's value matters.
TEST(TexturedParameters, AreTheValuesOfTheirTextures) {
  for (const Textured& t : kTextured) {
    SCOPED_TRACE(std::string(t.plugin) + ", " + t.parameter);
    const auto number = [&](const char* value) {
      return std::string(t.inside) + "<float name=\"" + t.parameter + "\" value=\"" + value + "\"/>";
    };
    const LoadedSides constant = load_bsdf(t.plugin, number("0.375")), other = load_bsdf(t.plugin, number("0.75"));
    const LoadedSides textured = load_bsdf(t.plugin, std::string(t.inside) + "<texture name=\"" + t.parameter +
                                                         R"(" type="checkerboard"><float name="color0" value="0.375"/>
                                <float name="color1" value="0.375"/></texture>)");
    ASSERT_TRUE(constant.front && textured.front && other.front);
    const auto wanted = figures_of(*constant.front), got = figures_of(*textured.front);
    EXPECT_NE(figures_of(*other.front), wanted);
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) ASSERT_NEAR(got[i], wanted[i], 1e-4f * wanted[i] + 1e-6f);
  }
}

}  // namespace
}  // namespace norrsken::isa_host
