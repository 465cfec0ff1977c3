#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

SurfaceRecord surface_of(const Compiled& compiled) { return compiled.tables().surfaces.at(0); }

std::vector<float> parameters_of(const Compiled& compiled, MaterialWord word) {
  const auto first = compiled.tables().parameters.begin() + (word & kMaterialOffsetMask);
  return {first, first + 3};
}

TEST(DiffuseHost, StoresItsReflectanceAndHasABlackBack) {
  const Compiled c = compile_bsdf(R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.1, 0.25, 1"/></bsdf>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(surface_of(c).material_front), BsdfKind::diffuse);
  EXPECT_EQ(surface_of(c).material_back, make_material(BsdfKind::absorb, 0));
  EXPECT_THAT(parameters_of(c, surface_of(c).material_front), ElementsAre(0.1f, 0.25f, 1.0f));
}

TEST(DiffuseHost, ReflectsHalfUnlessTold) {
  const Compiled c = compile_bsdf(R"(<bsdf type="diffuse"/>)");
  EXPECT_THAT(parameters_of(c, surface_of(c).material_front), ElementsAre(0.5f, 0.5f, 0.5f));
}

TEST(DiffuseHost, ReflectanceZeroAbsorbs) {
  const Compiled c = compile_bsdf(R"(<bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(surface_of(c).material_front, make_material(BsdfKind::absorb, 0));
  EXPECT_THAT(c.tables().parameters, IsEmpty());
}

TEST(DiffuseHost, RefusesWhatReflectsMoreThanArrives) {
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.5, 1.5, 0"/></bsdf>)").messages(),
              ElementsAre("error: 'reflectance' is (0.5, 1.5, 0) [components from 0 to 1]"));
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="diffuse"><string name="reflectance" value="red"/></bsdf>)").messages(),
              ElementsAre("error: 'reflectance' is a string [rgb, spectrum, float]"));
}

TEST(DiffuseHost, RefusesUnknownParameters) {
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="diffuse"><rgb name="reflectence" value="0.5"/></bsdf>)").messages(),
              ElementsAre("error: unused parameter 'reflectence' of bsdf 'diffuse', did you mean 'reflectance'? "
                          "[reflectance]"));
}

TEST(TwosidedHost, GivesBothSidesTheOneBsdf) {
  const Compiled c = compile_bsdf(R"(<bsdf type="twosided"><bsdf type="diffuse"/></bsdf>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(surface_of(c).material_front), BsdfKind::diffuse);
  EXPECT_EQ(surface_of(c).material_back, surface_of(c).material_front);
}

TEST(TwosidedHost, GivesEachSideItsOwn) {
  const Compiled c = compile_bsdf(R"(<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="conductor"/></bsdf>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(material_kind(surface_of(c).material_front), BsdfKind::diffuse);
  EXPECT_EQ(material_kind(surface_of(c).material_back), BsdfKind::conductor);
}

TEST(TwosidedHost, NeedsOneOrTwo) {
  const std::string accepted = " [one bsdf for both sides, or one for the front and one for the back]";
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="twosided"/>)").messages(),
              ElementsAre("error: bsdf 'twosided' has no bsdf inside" + accepted));
  EXPECT_THAT(
      compile_bsdf(R"(<bsdf type="twosided"><bsdf type="diffuse"/><bsdf type="diffuse"/><bsdf type="diffuse"/></bsdf>)")
          .messages(),
      ElementsAre("error: bsdf 'twosided' has more than two bsdfs inside" + accepted));
}

TEST(BsdfHost, NestingHasAnEnd) {
  std::string bsdf = R"(<bsdf type="diffuse"/>)";
  for (int i = 0; i < 70; ++i) bsdf = "<bsdf type=\"twosided\">" + bsdf + "</bsdf>";
  EXPECT_FALSE(compile_bsdf(bsdf).scene);
}

TEST(BsdfHost, ShapesThatReferToOneBsdfShareItsParameters) {
  const Compiled c = compile_shape(
      R"(<bsdf type="diffuse" id="a"/><shape type="sphere"><ref id="a"/></shape><shape type="sphere"><ref id="a"/></shape>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().parameters.size(), 4u);
  EXPECT_EQ(c.tables().surfaces.at(0).material_front, c.tables().surfaces.at(1).material_front);
}

TEST(BsdfHost, AShapeWithoutBsdfIsDiffuseOfAHalf) {
  const Compiled c = compile_shape(kShape + kShape);
  EXPECT_EQ(material_kind(surface_of(c).material_front), BsdfKind::diffuse);
  EXPECT_THAT(c.tables().parameters, ElementsAre(0.5f, 0.5f, 0.5f, 0.0f));
}

TEST(BsdfHost, TellsMisspeltFromMissing) {
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="difuse"/>)").messages(),
              ElementsAre(StartsWith("error: unknown bsdf 'difuse', did you mean 'diffuse'? [")));
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="measured"/>)").messages(),
              ElementsAre(StartsWith("error: bsdf 'measured' is not supported yet [")));
}

/// As Blender's exporter writes every tint: what counts, and is held against the range, is the mean.
TEST(BsdfHost, ColoursAreNumbersWhereTexturesMayStand) {
  const auto parameters = [](const std::string& value) {
    const Compiled c = compile_bsdf(R"(<bsdf type="principled">)" + value + "</bsdf>");
    EXPECT_THAT(c.messages(), IsEmpty());
    return std::vector<float>(c.tables().parameters.begin(), c.tables().parameters.end());
  };
  for (const char* name : {"roughness", "metallic", "anisotropic", "spec_tint", "sheen_tint", "clearcoat"}) {
    const std::string named = std::string(" name=\"") + name + "\" value=";
    const auto wanted = parameters("<float" + named + "\"0.4\"/>");
    EXPECT_EQ(parameters("<rgb" + named + "\"0.1 0.2 0.9\"/>"), wanted) << name;
    EXPECT_EQ(parameters("<rgb" + named + "\"0.4\"/>"), wanted) << name;
    EXPECT_EQ(parameters("<spectrum" + named + "\"0.4\"/>"), wanted) << name;
    EXPECT_EQ(parameters("<rgb" + named + "\"0 0 1.2\"/>"), wanted) << name;
  }
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="principled"><rgb name="metallic" value="1 2 3"/></bsdf>)").messages(),
              ElementsAre("warning: 'metallic' is 2, which is taken for 1 [a number from 0 to 1]"));
  EXPECT_THAT(compile_bsdf(R"(<bsdf type="bumpmap"><rgb name="scale" value="1"/></bsdf>)").messages(),
              ::testing::Contains("error: 'scale' is an rgb [float]"));
}

}  // namespace
}  // namespace norrsken::testing
