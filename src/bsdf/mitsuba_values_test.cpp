// Plastics and Disney's materials against numbers that Mitsuba 3.9 gives for them.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bsdf/bsdf_testing.h"

namespace norrsken::isa_host {
namespace {

struct Value {
  const char* plugin;
  const char* inside;  ///< besides a color
  bool below;          ///< where the light comes from
  std::array<double, 3> value;
  double pdf_sa;
};

constexpr Value kValues[] = {
    {"plastic", R"()", false, {0.205535, 0.12846, 0.0770758}, 0.235077},
    {"plastic",
     R"(<string name="int_ior" value="diamond"/><boolean name="nonlinear" value="true"/>)",
     false,
     {0.0776792, 0.0261565, 0.012003},
     0.181891},
    {"roughplastic", R"(<float name="alpha" value="0.3"/>)", false, {0.202557, 0.136886, 0.0931062}, 0.288665},
    {"roughplastic",
     R"(<float name="alpha" value="0.2"/><float name="int_ior" value="1.9"/><string name="distribution" value="ggx"/><boolean name="nonlinear" value="true"/>)",
     false,
     {0.141784, 0.0890225, 0.0682309},
     0.295941},
    {"principled", R"()", false, {0.224497, 0.148094, 0.097159}, 0.371132},
    {"principled",
     R"(<float name="metallic" value="1"/><float name="roughness" value="0.3"/><float name="anisotropic" value="0.7"/>)",
     false,
     {0.0331063, 0.0206942, 0.0124195},
     0.0414687},
    {"principled",
     R"(<float name="metallic" value="0.5"/><float name="specular" value="0"/><float name="spec_tint" value="1"/>)",
     false,
     {0.101871, 0.0636692, 0.0382015},
     0.409961},
    {"principled",
     R"(<float name="sheen" value="1"/><float name="sheen_tint" value="0.5"/><float name="flatness" value="0.7"/><float name="clearcoat" value="1"/><float name="clearcoat_gloss" value="0.3"/>)",
     false,
     {0.201582, 0.136848, 0.0936913},
     0.363742},
    {"principled",
     R"(<float name="spec_trans" value="1"/><float name="sheen" value="1"/>)",
     false,
     {0.020756, 0.020756, 0.020756},
     0.0209369},
    {"principled",
     R"(<float name="spec_trans" value="0.7"/><float name="eta" value="1.4"/><float name="metallic" value="0.2"/>)",
     true,
     {0.00469368, 0.00371068, 0.00287428},
     0.00836702},
    {"principledthin",
     R"(<float name="spec_trans" value="0.5"/><float name="diff_trans" value="0.8"/><float name="sheen" value="0.5"/><float name="flatness" value="0.5"/><float name="spec_tint" value="0.5"/>)",
     false,
     {0.0667024, 0.0436509, 0.0282833},
     0.198299},
    {"principledthin",
     R"(<float name="spec_trans" value="0.5"/><float name="diff_trans" value="0.8"/><float name="sheen" value="0.5"/><float name="eta" value="1.3"/>)",
     true,
     {0.0541511, 0.0338444, 0.0203067},
     0.0594706},
};

TEST(MitsubasValues, AreOurs) {
  const Vec3f wo{Float(0.6f), Float(0.0f), Float(0.8f)};
  const Vec3f above{Float(-0.48f), Float(-0.36f), Float(0.8f)}, below{Float(-0.36f), Float(-0.48f), Float(-0.8f)};
  for (const Value& v : kValues) {
    const std::string plugin = v.plugin;
    SCOPED_TRACE(plugin + " " + v.inside);
    const char* color = plugin.ends_with("plastic") ? "diffuse_reflectance" : "base_color";
    const LoadedSides sides =
        load_bsdf(plugin, "<rgb name=\"" + std::string(color) + "\" value=\"0.8, 0.5, 0.3\"/>" + v.inside);
    ASSERT_TRUE(sides.front);
    // The tables of rough plastic differ a little.
    const double tolerance = plugin == "roughplastic" ? 1e-3 : 2e-5;
    const Vec3f wi = v.below ? below : above;
    const Color value = sides.front->evaluate(wo, wi);
    EXPECT_NEAR(double(value.r.v), v.value[0], tolerance * v.value[0]);
    EXPECT_NEAR(double(value.g.v), v.value[1], tolerance * v.value[1]);
    EXPECT_NEAR(double(value.b.v), v.value[2], tolerance * v.value[2]);
    // Of principled the lobes are sampled by what they send, in Mitsuba in fixed shares.
    if (plugin != "principled") {
      EXPECT_NEAR(double(sides.front->pdf_sa(wo, wi)), v.pdf_sa, 4e-3 * v.pdf_sa);
    }
  }
}

}  // namespace
}  // namespace norrsken::isa_host
