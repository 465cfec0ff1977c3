// principled and principledthin: their parameters, and what must come out of them.
#include "bsdf/principled.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/bsdf_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Compiled compile(const std::string& plugin, const std::string& inside) {
  return compile_bsdf("<bsdf type=\"" + plugin + "\">" + inside + "</bsdf>");
}
std::string number(const std::string& name, const std::string& value) {
  return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}
MaterialWord front_of(const Compiled& c) { return c.tables().surfaces.at(0).material_front; }
MaterialWord back_of(const Compiled& c) { return c.tables().surfaces.at(0).material_back; }
float stored(const Compiled& c, MaterialWord word, std::size_t k) {
  return c.tables().parameters.at((word & kMaterialOffsetMask) + k);
}

struct Stored {
  const char* name;
  std::size_t place;
  float fallback;
};

const Stored kPrincipled[] = {{"roughness", 4, 0.5f},
                              {"anisotropic", 6, 0},
                              {"metallic", 8, 0},
                              {"spec_trans", 10, 0},
                              {"spec_tint", 12, 0},
                              {"sheen", 14, 0},
                              {"sheen_tint", 16, 0},
                              {"flatness", 18, 0},
                              {"clearcoat", 20, 0},
                              {"clearcoat_gloss", 22, 0},
                              {"diffuse_reflectance_sampling_rate", 26, 1},
                              {"main_specular_sampling_rate", 27, 1},
                              {"clearcoat_sampling_rate", 28, 1}};
const Stored kThin[] = {{"roughness", 4, 0.5f},
                        {"anisotropic", 6, 0},
                        {"spec_trans", 8, 0},
                        {"spec_tint", 10, 0},
                        {"sheen", 12, 0},
                        {"sheen_tint", 14, 0},
                        {"flatness", 16, 0},
                        {"eta", 18, 1.5f},
                        {"diff_trans", 20, 0},
                        {"specular_reflectance_sampling_rate", 22, 1},
                        {"specular_transmittance_sampling_rate", 23, 1},
                        {"diffuse_reflectance_sampling_rate", 24, 1},
                        {"diffuse_transmittance_sampling_rate", 25, 1}};

template <class Table>
void check_numbers(const std::string& plugin, const Table& table) {
  for (const Stored& s : table) {
    SCOPED_TRACE(plugin + ", " + s.name);
    const Compiled missing = compile(plugin, "");
    EXPECT_EQ(stored(missing, front_of(missing), s.place), s.fallback);
    const Compiled given = compile(plugin, number(s.name, "0.375"));
    ASSERT_THAT(given.messages(), IsEmpty());
    EXPECT_EQ(stored(given, front_of(given), s.place), 0.375f);
    EXPECT_THAT(compile(plugin, number(s.name, "-1")).messages(),
                ElementsAre(HasSubstr("'" + std::string(s.name) + "' is -1")));
    EXPECT_THAT(compile(plugin, "<string name=\"" + std::string(s.name) + "\" value=\"much\"/>").messages(),
                ElementsAre(HasSubstr("error: '" + std::string(s.name) + "' is a string")));
  }
}

TEST(PrincipledHost, TakesItsNumbers) { check_numbers("principled", kPrincipled); }
TEST(PrincipledThinHost, TakesItsNumbers) { check_numbers("principledthin", kThin); }

TEST(PrincipledHost, TakesItsColor) {
  for (const char* plugin : {"principled", "principledthin"}) {
    const Compiled missing = compile(plugin, "");
    EXPECT_EQ(stored(missing, front_of(missing), 0), 0.5f);
    const Compiled c = compile(plugin, R"(<rgb name="base_color" value="0.1, 0.2, 0.3"/>)");
    ASSERT_THAT(c.messages(), IsEmpty());
    EXPECT_EQ(stored(c, front_of(c), 2), 0.3f);
    EXPECT_THAT(compile(plugin, number("base_color", "2")).messages(),
                ElementsAre("error: 'base_color' is (2, 2, 2) [components from 0 to 1]"));
    EXPECT_THAT(compile(plugin, R"(<string name="base_color" value="red"/>)").messages(),
                ElementsAre(HasSubstr("error: 'base_color' is a string")));
    EXPECT_THAT(compile(plugin, number("roughnes", "1")).messages(),
                ElementsAre(HasSubstr("did you mean 'roughness'?")));
    EXPECT_THAT(compile(plugin, number("metallic", "2")).messages(), ::testing::SizeIs(1));
  }
}

TEST(PrincipledHost, TakesAnIndexOrWhatItReflects) {
  const auto eta = [](const std::string& inside) {
    const Compiled c = compile("principled", inside);
    EXPECT_THAT(c.messages(), IsEmpty());
    return stored(c, front_of(c), 24);
  };
  EXPECT_FLOAT_EQ(eta(""), 1.5f);  // 0.5 reflects 0.04
  EXPECT_FLOAT_EQ(eta(number("specular", "0")), 1.0f);
  EXPECT_NEAR(eta(number("specular", "0") + number("spec_trans", "1")), 1.01805f, 1e-5f);
  EXPECT_FLOAT_EQ(eta(number("eta", "1.7")), 1.7f);
  EXPECT_FLOAT_EQ(eta(number("eta", "1") + number("spec_trans", "1")), 1.001f);
  EXPECT_THAT(compile("principled", number("eta", "1.5") + number("specular", "0.5")).messages(),
              ElementsAre("error: 'specular' is given next to 'eta' [eta or specular]"));
  EXPECT_THAT(compile("principled", number("eta", "0")).messages(), ElementsAre(HasSubstr("error: 'eta' is 0")));
  EXPECT_THAT(compile("principled", number("specular", "2")).messages(),
              ElementsAre("warning: 'specular' is 2, which is taken for 1 [a number from 0 to 1]"));
}

TEST(PrincipledHost, HasAnInsideOnlyIfLightGetsThere) {
  const Compiled opaque = compile("principled", "");
  EXPECT_EQ(back_of(opaque), make_material(BsdfKind::absorb, 0));
  const Compiled glass = compile("principled", number("spec_trans", "0.5") + number("eta", "1.6"));
  ASSERT_EQ(material_kind(back_of(glass)), BsdfKind::principled);
  EXPECT_FLOAT_EQ(stored(glass, back_of(glass), 24), 1 / 1.6f);
  EXPECT_EQ(stored(glass, back_of(glass), 25), 1.0f);
  const Compiled thin = compile("principledthin", "");
  EXPECT_EQ(back_of(thin), front_of(thin));
}

using isa_host::Float;
using isa_host::Vec3f;
const Vec3f kOut{Float(0.6f), Float(0.0f), Float(0.8f)}, kIn{Float(0.0f), Float(-0.8f), Float(0.6f)};

/// Metal seen head on has the base colour: the lobe's value over that of a white one.
TEST(Principled, MetalHasTheBaseColor) {
  const auto gold =
      isa_host::load_bsdf("principled", R"(<rgb name="base_color" value="0.9, 0.6, 0.2"/>)" + number("metallic", "1"));
  const auto white = isa_host::load_bsdf("principled", number("base_color", "1") + number("metallic", "1"));
  const Vec3f up{Float(0.0f), Float(0.0f), Float(1.0f)};
  const isa_host::Color a = gold.front->evaluate(up, up), b = white.front->evaluate(up, up);
  EXPECT_NEAR(a.r.v / b.r.v, 0.9f, 1e-5f);
  EXPECT_NEAR(a.b.v / b.b.v, 0.2f, 1e-5f);
}

/// Were each lobe sampled as often as it sends light, all samples would weigh the same; by turns they do not nearly.
TEST(Principled, SamplesItsLobesByWhatTheySend) {
  const std::string lacquer = R"(<rgb name="base_color" value="0.8, 0.7, 0.6"/>)" + number("roughness", "0.3");
  for (const std::string& more : {std::string(), number("clearcoat", "1"), number("metallic", "0.5")}) {
    const auto sides = isa_host::load_bsdf("principled", lacquer + more);
    double sum = 0, squares = 0;
    constexpr int kSteps = 24;
    for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
      const auto u = [&](int k) { return (static_cast<float>(k % kSteps) + 0.5f) / static_cast<float>(kSteps); };
      const isa_host::BsdfSample sample =
          sides.front->sample(kOut, u(i), {Float(u(i / kSteps)), Float(u(i / kSteps / kSteps))});
      const double weight = sample.valid.v ? double{sample.weight.g.v} : 0;
      sum += weight, squares += weight * weight;
    }
    EXPECT_LT(squares * kSteps * kSteps * kSteps / (sum * sum) - 1, 0.2) << more;
  }
}

TEST(PrincipledThin, DiffuseLightPassesInProportion) {
  const auto sheet = isa_host::load_bsdf("principledthin", number("base_color", "0.6") + number("diff_trans", "2"));
  const Vec3f through{kIn.x, kIn.y, -kIn.z};
  EXPECT_NEAR(sheet.front->evaluate(kOut, through).r.v, 0.6f * 0.6f / float(M_PI), 1e-6f);
  EXPECT_EQ(sheet.front->evaluate(kOut, kIn).r.v, 0.0f);
}

}  // namespace
}  // namespace norrsken::testing
