// Host sides of what stands before other BSDFs: each parameter right, missing, of the wrong type, out of range, unused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kDiffuse = R"(<bsdf type="diffuse"/>)";
const std::string kTwosided = "<bsdf type=\"twosided\">" + kDiffuse + "</bsdf>";
const std::string kNull = R"(<bsdf type="null"/>)";

std::string adapter(const std::string& type, const std::string& inside) {
  return "<bsdf type=\"" + type + "\">" + inside + "</bsdf>";
}
std::vector<std::string> messages(const std::string& type, const std::string& inside) {
  return compile_bsdf(adapter(type, inside)).messages();
}

MaterialWord front(const Compiled& c) { return c.tables().surfaces.at(0).material_front; }
MaterialWord back(const Compiled& c) { return c.tables().surfaces.at(0).material_back; }
float number(const Compiled& c, MaterialWord word, std::size_t k) {
  return c.tables().parameters.at((word & kMaterialOffsetMask) + k);
}
MaterialWord word(const Compiled& c, MaterialWord word, std::size_t k) {
  return std::bit_cast<MaterialWord>(number(c, word, k));
}

TEST(NullHost, IsTheSameOnBothSides) {
  const Compiled c = compile_bsdf(kNull);
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front(c)), BsdfKind::null);
  EXPECT_EQ(material_kind(back(c)), BsdfKind::null);
  EXPECT_THAT(messages("null", R"(<float name="opacity" value="1"/>)"),
              ElementsAre("error: unused parameter 'opacity' of bsdf 'null' [no parameters]"));
}

TEST(MaskHost, LeadsToWhatIsInsideOrToNothing) {
  const Compiled c = compile_bsdf(adapter("mask", R"(<float name="opacity" value="0.25"/>)" + kDiffuse));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front(c)), BsdfKind::mask);
  EXPECT_EQ(number(c, front(c), 0), 0.25f);
  EXPECT_EQ(material_kind(word(c, front(c), 2)), BsdfKind::diffuse);
  EXPECT_EQ(material_kind(word(c, front(c), 3)), BsdfKind::null);
  EXPECT_EQ(word(c, back(c), 2), make_material(BsdfKind::absorb, 0)) << "diffuse has a black back";
  EXPECT_EQ(c.tables().bsdf_kinds,
            1u << int(BsdfKind::diffuse) | 1u << int(BsdfKind::null) | 1u << int(BsdfKind::mask));

  const Compiled two = compile_bsdf(adapter("mask", kTwosided));
  EXPECT_EQ(number(two, front(two), 0), 0.5f) << "the default";
  EXPECT_EQ(word(two, back(two), 2), word(two, front(two), 2));
}

TEST(MaskHost, TakesATexture) {
  const Compiled c = compile_bsdf(adapter("mask", R"(<texture name="opacity" type="checkerboard"/>)" + kDiffuse));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(texture_kind(word(c, front(c), 1)), TextureKind::checkerboard);
}

TEST(MaskHost, Refusals) {
  EXPECT_THAT(messages("mask", ""), ElementsAre("error: bsdf 'mask' has no bsdfs inside [one bsdf]"));
  EXPECT_THAT(messages("mask", kDiffuse + kNull), ElementsAre("error: bsdf 'mask' has 2 bsdfs inside [one bsdf]"));
  EXPECT_THAT(messages("mask", R"(<float name="opacity" value="1.5"/>)" + kDiffuse),
              ElementsAre("warning: 'opacity' is 1.5, which is taken for 1 [a number from 0 to 1]"));
  EXPECT_THAT(messages("mask", R"(<string name="opacity" value="1"/>)" + kDiffuse),
              ElementsAre("error: 'opacity' is a string [float, rgb, spectrum]"));
  EXPECT_THAT(messages("mask", R"(<float name="opacty" value="1"/>)" + kDiffuse),
              ElementsAre("error: unused parameter 'opacty' of bsdf 'mask', did you mean 'opacity'? [opacity]"));
}

TEST(BlendHost, LeadsToBoth) {
  const Compiled c = compile_bsdf(adapter("blendbsdf", R"(<float name="weight" value="0.75"/>)" + kDiffuse + kNull));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front(c)), BsdfKind::blendbsdf);
  EXPECT_EQ(number(c, front(c), 0), 0.75f);
  EXPECT_EQ(material_kind(word(c, front(c), 2)), BsdfKind::diffuse);
  EXPECT_EQ(material_kind(word(c, front(c), 3)), BsdfKind::null);
  EXPECT_EQ(word(c, back(c), 2), make_material(BsdfKind::absorb, 0));
  EXPECT_EQ(material_kind(word(c, back(c), 3)), BsdfKind::null);
}

TEST(BlendHost, Refusals) {
  const std::string weight = R"(<float name="weight" value="0.5"/>)";
  EXPECT_THAT(
      messages("blendbsdf", kDiffuse + kNull),
      ElementsAre("error: bsdf 'blendbsdf' needs a parameter 'weight' [<float name=\"weight\" value=\"0.5\"/>]"));
  EXPECT_THAT(messages("blendbsdf", weight + kDiffuse),
              ElementsAre("error: bsdf 'blendbsdf' has 1 bsdf inside [two bsdfs]"));
  EXPECT_THAT(messages("blendbsdf", R"(<float name="weight" value="-1"/>)" + kDiffuse + kNull),
              ElementsAre("warning: 'weight' is -1, which is taken for 0 [a number from 0 to 1]"));
  EXPECT_THAT(messages("blendbsdf", R"(<string name="weight" value="a"/>)" + kDiffuse + kNull),
              ElementsAre("error: 'weight' is a string [float, rgb, spectrum]"));
  EXPECT_THAT(messages("blendbsdf", weight + kDiffuse + kNull + R"(<float name="opacity" value="1"/>)"),
              ElementsAre("error: unused parameter 'opacity' of bsdf 'blendbsdf' [weight]"));
}

TEST(NormalMapHost, StoresNormalsAndFlags) {
  const Compiled c = compile_bsdf(
      adapter("normalmap",
              R"(<texture name="normalmap" type="rawconstant"><vector name="value" value="0.5, 0.25, 1"/></texture>)"
              R"(<boolean name="use_shadowing_function" value="false"/>)" +
                  kTwosided));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(front(c)), BsdfKind::normalmap);
  EXPECT_EQ(material_kind(word(c, front(c), 0)), BsdfKind::diffuse);
  EXPECT_EQ(word(c, front(c), 1), word(c, front(c), 0)) << "of the twosided inside";
  EXPECT_EQ(word(c, front(c), 2), kPerturbFlips) << "no shadowing";
  EXPECT_EQ(word(c, back(c), 2), kPerturbFlips | kPerturbBack);
  EXPECT_EQ(number(c, front(c), 4), 0.25f);
  EXPECT_TRUE(c.tables().needs_uv);
}

TEST(NormalMapHost, Refusals) {
  const std::string map = R"(<rgb name="normalmap" value="0.5, 0.5, 1"/>)";
  EXPECT_THAT(
      messages("normalmap", kDiffuse),
      ElementsAre(
          "error: bsdf 'normalmap' needs a parameter 'normalmap' [<texture name=\"normalmap\" type=\"bitmap\">]"));
  EXPECT_THAT(messages("normalmap", map), ElementsAre("error: bsdf 'normalmap' has no bsdfs inside [one bsdf]"));
  EXPECT_THAT(messages("normalmap", map + R"(<integer name="flip_invalid_normals" value="1"/>)" + kDiffuse),
              ElementsAre("error: 'flip_invalid_normals' is an integer [boolean]"));
  EXPECT_THAT(messages("normalmap", map + R"(<float name="scale" value="1"/>)" + kDiffuse),
              ElementsAre("error: unused parameter 'scale' of bsdf 'normalmap' "
                          "[flip_invalid_normals, normalmap, use_shadowing_function]"));
}

TEST(NormalMapHost, SaysThatPathsFromTheLightsFoldNormalsOtherwise) {
  const std::string scene = kSensor + kEmitter + R"(<shape type="sphere">)";
  const auto told = [&](const std::string& integrator, const std::string& flips) {
    return compile_elements("<integrator type=\"" + integrator + "\"/>" + scene +
                            adapter("normalmap", R"(<rgb name="normalmap" value="0.5, 0.5, 1"/>)" + flips + kDiffuse) +
                            "</shape>")
        .messages();
  };
  const std::string off = R"(<boolean name="flip_invalid_normals" value="false"/>)";
  EXPECT_THAT(told("ptracer", ""),
              ElementsAre("warning: normals that turn away are folded back by where the light is, where 'path' folds "
                          "them by the viewer: with integrator 'ptracer' the image is another one, mostly brighter "
                          "[<boolean name=\"flip_invalid_normals\" value=\"false\"/>, or another integrator]"));
  EXPECT_THAT(told("ptracer", off), IsEmpty());
  EXPECT_THAT(told("path", ""), IsEmpty());
}

TEST(NormalMapHost, AsManyInsideEachOtherAsAHitRemembers) {
  const std::string map = R"(<rgb name="normalmap" value="0.5, 0.5, 1"/>)";
  std::string nested = kDiffuse;
  for (std::uint32_t i = 0; i < kMostMaps; ++i) nested = adapter("mask", adapter("normalmap", map + nested));
  EXPECT_THAT(messages("twosided", nested), IsEmpty());
  EXPECT_THAT(messages("normalmap", map + nested),
              ElementsAre("error: 5 bump and normal maps stand inside each other [up to 4]"));
}

TEST(BumpMapHost, Refusals) {
  EXPECT_THAT(messages("bumpmap", kDiffuse), ElementsAre("error: bsdf 'bumpmap' has no texture inside [one bitmap]"));
  EXPECT_THAT(messages("bumpmap", R"(<texture name="any" type="checkerboard"/>)" + kDiffuse),
              ElementsAre("error: the texture of a bumpmap has no slopes [a bitmap]"));
  EXPECT_THAT(
      messages("bumpmap", R"(<string name="scale" value="1"/>)" + kDiffuse),
      ElementsAre("error: 'scale' is a string [float]", "error: bsdf 'bumpmap' has no texture inside [one bitmap]"));
  EXPECT_THAT(
      messages("bumpmap", R"(<texture type="bitmap"/>)" + kDiffuse),
      ElementsAre("error: texture 'bitmap' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
}

// A tree of blends in which each level names the level below twice: as many paths as 2^60, and no more work than 60.
TEST(NestedHost, ManyPathsAreWalkedOnce) {
  std::string scene = R"(<bsdf type="diffuse" id="b0"/>)";
  for (int level = 1; level <= 60; ++level) {
    const std::string below = "<ref id=\"b" + std::to_string(level - 1) + "\"/>";
    scene += "<bsdf type=\"blendbsdf\" id=\"b" + std::to_string(level) + "\"><float name=\"weight\" value=\"0.5\"/>" +
             below + below + "</bsdf>";
  }
  const Compiled c = compile_elements(
      scene + kSensor + kEmitter +
      R"(<shape type="sphere"><bsdf type="normalmap"><rgb name="normalmap" value="0.5, 0.5, 1"/><ref id="b60"/></bsdf></shape>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_LT(c.tables().parameters.size(), 1000u);
}

}  // namespace
}  // namespace norrsken::testing
