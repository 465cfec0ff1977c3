// Media, phase functions and volumes of scene files: what becomes of them, and what is complained about.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kVolpath = R"(<integrator type="volpath"/>)";

Compiled compile_medium(const std::string& type, const std::string& inside, const Files& files = {}) {
  return compile_elements(kVolpath + kSensor + kEmitter +
                              R"(<shape type="sphere" id="ball"><bsdf type="null"/><medium name="interior" type=")" +
                              type + "\">" + inside + "</medium></shape>",
                          files);
}
Compiled compile_phase(const std::string& phase) { return compile_medium("homogeneous", phase); }

/// A volume file of these values, in the unit cube.
std::string vol(std::int32_t nx, std::int32_t ny, std::int32_t nz, std::int32_t channels,
                const std::vector<float>& values, const std::array<float, 6>& box = {0, 0, 0, 1, 1, 1}) {
  std::string bytes = "VOL\x03";
  const std::int32_t head[] = {1, nx, ny, nz, channels};
  bytes.append(reinterpret_cast<const char*>(head), sizeof head);
  bytes.append(reinterpret_cast<const char*>(box.data()), sizeof box);
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  return bytes;
}
std::string grid(const std::string& name, const std::string& inside = "") {
  return "<volume type=\"gridvolume\" name=\"" + name + R"("><string name="filename" value="g.vol"/>)" + inside +
         "</volume>";
}

TEST(MediumHost, AHomogeneousOneWithoutParameters) {
  const Compiled c = compile_medium("homogeneous", "");
  EXPECT_THAT(c.messages(), IsEmpty());
  ASSERT_EQ(c.tables().media.size(), 1u);
  const MediumRecord& m = c.tables().media[0];
  EXPECT_THAT(m.sigma_t, ElementsAre(1.0f, 1.0f, 1.0f));
  EXPECT_THAT(m.albedo, ElementsAre(0.75f, 0.75f, 0.75f));
  EXPECT_EQ(m.scatters, 1u);
  EXPECT_EQ(m.sample_emitters, 1u);
  EXPECT_EQ(m.sigma_volume, kNone);
  EXPECT_EQ(m.phase >> 24, static_cast<std::uint32_t>(PhaseKind::isotropic));
  EXPECT_EQ(c.tables().shapes[0].interior, 0u);
  EXPECT_EQ(c.tables().shapes[0].exterior, kNone) << "a vacuum";
  EXPECT_EQ(c.tables().camera.medium, kNone);
}

TEST(MediumHost, ScalesTheExtinction) {
  const Compiled c = compile_medium(
      "homogeneous",
      R"(<rgb name="sigma_t" value="0.1 2 0"/><float name="scale" value="3"/><rgb name="albedo" value="0 0 0"/>
         <boolean name="sample_emitters" value="false"/><boolean name="has_spectral_extinction" value="false"/>)");
  EXPECT_THAT(c.messages(), ElementsAre(HasSubstr("'has_spectral_extinction'")));
  const MediumRecord& m = c.tables().media[0];
  EXPECT_THAT(m.sigma_t, ElementsAre(FloatEq(0.3f), FloatEq(6.0f), 0.0f));
  EXPECT_EQ(m.scatters, 0u);
  EXPECT_EQ(m.sample_emitters, 0u);
}

TEST(MediumHost, RefusesWhatIsNoMedium) {
  EXPECT_THAT(compile_medium("homogeneous", R"(<float name="sigma_t" value="1e14"/><float name="scale" value="1e3"/>)")
                  .messages(),
              ElementsAre("error: an extinction of 1e+17 per unit of length [up to 1e+15, with 'scale']"));
  EXPECT_THAT(compile_medium("homogeneous", R"(<float name="sigma_t" value="-1"/>)").messages(),
              ElementsAre(HasSubstr("error: 'sigma_t'")));
  EXPECT_THAT(compile_medium("homogeneous", R"(<rgb name="albedo" value="0.5 1.5 0.5"/>)").messages(),
              ElementsAre(HasSubstr("error: 'albedo'")));
  EXPECT_THAT(compile_medium("foggy", "").messages(),
              ElementsAre("error: unknown medium 'foggy' [heterogeneous, homogeneous]"));
}

TEST(MediumHost, IsTakenNoNoticeOfByPath) {
  EXPECT_THAT(compile_shape(R"(<shape type="sphere"><medium name="exterior" type="homogeneous"/></shape>)").messages(),
              ElementsAre("warning: integrator 'path' takes no notice of medium 'homogeneous' [integrator 'volpath']"));
}

TEST(MediumHost, OneThatSeveralReferToIsCompiledOnce) {
  const Compiled c = compile_elements(
      kVolpath + R"(<medium type="homogeneous" id="fog"/><emitter type="point"><ref id="fog"/></emitter>
      <sensor type="perspective"><ref id="fog"/></sensor>
      <shape type="sphere"><ref id="fog" name="exterior"/></shape><shape type="cube"><ref id="fog" name="interior"/></shape>)");
  EXPECT_THAT(c.messages(), IsEmpty());
  ASSERT_EQ(c.tables().media.size(), 1u);
  EXPECT_EQ(c.tables().shapes[0].exterior, 0u);
  EXPECT_EQ(c.tables().shapes[0].interior, kNone);
  EXPECT_EQ(c.tables().shapes[1].interior, 0u);
  EXPECT_EQ(c.tables().camera.medium, 0u);
}

TEST(PhaseHost, HenyeyGreensteinTakesWhatIsBetween) {
  EXPECT_THAT(compile_phase(R"(<phase type="hg"><float name="g" value="-0.99"/></phase>)").messages(), IsEmpty());
  for (const std::string g : {"1", "-1", "1.5"})
    EXPECT_THAT(compile_phase(R"(<phase type="hg"><float name="g" value=")" + g + R"("/></phase>)").messages(),
                ElementsAre(HasSubstr("error: 'g'")));
}

TEST(VolumeHost, AGridTellsItsMajorants) {
  const Compiled c = compile_medium("heterogeneous", grid("sigma_t") + R"(<float name="scale" value="2"/>)",
                                    {{"g.vol", vol(2, 1, 1, 1, {1, 3})}});
  EXPECT_THAT(c.messages(), IsEmpty());
  const MediumRecord& m = c.tables().media[0];
  ASSERT_EQ(m.sigma_volume, 0u);
  EXPECT_EQ(c.tables().volumes[0].size_x, 2.0f);
  EXPECT_EQ(m.cells_x * m.cells_y * m.cells_z, 1.0f);
  EXPECT_THAT(c.tables().texels[m.majorants], FloatEq(6 * (1 + 1e-6f)));
}

/// A cell is never below what the interpolation finds in it, nor far above.
TEST(VolumeHost, MajorantsAreThoseOfTheirCells) {
  std::vector<float> values(64, 1.0f);
  values[40] = 9;
  for (const std::string wrap : {"clamp", "repeat", "mirror"}) {
    const Compiled c =
        compile_medium("heterogeneous", grid("sigma_t", R"(<string name="wrap_mode" value=")" + wrap + "\"/>"),
                       {{"g.vol", vol(64, 1, 1, 1, values)}});
    const MediumRecord& m = c.tables().media[0];
    ASSERT_EQ(m.cells_x, 8.0f);
    for (std::uint32_t cell = 0; cell < 8; ++cell) {
      // The value in voxel 40 is met from 39.5 to 41.5, in the middle of voxels.
      // At its faces a grid that goes on may meet any of them.
      const bool meets = cell == 4 || cell == 5 || (wrap != "clamp" && (cell == 0 || cell == 7));
      EXPECT_THAT(c.tables().texels[m.majorants + cell], FloatEq((meets ? 9 : 1) * (1 + 1e-6f))) << cell << wrap;
    }
  }
}

TEST(VolumeHost, TheBoxOfTheFile) {
  const Files files = {{"g.vol", vol(1, 1, 1, 1, {1}, {-1, -2, -3, 1, 2, 5})}};
  const Compiled c =
      compile_medium("heterogeneous", grid("sigma_t", R"(<boolean name="use_grid_bbox" value="true"/>)"), files);
  EXPECT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(c.tables().media[0].lower, ElementsAre(-1.0f, -2.0f, -3.0f));
  EXPECT_THAT(c.tables().media[0].upper, ElementsAre(1.0f, 2.0f, 5.0f));
  EXPECT_THAT(compile_medium("heterogeneous", grid("sigma_t", R"(<boolean name="use_grid_bbox" value="true"/>)"),
                             {{"g.vol", vol(1, 1, 1, 1, {1}, {0, 0, 0, 1, 0, 1})}})
                  .messages(),
              ElementsAre("error: the bounding box of the volume goes from 0 to 0 along y [a box that is not empty]"));
}

TEST(VolumeHost, WhatIsWrongWithAGrid) {
  const auto messages = [](const std::string& bytes, const std::string& name = "sigma_t") {
    return compile_medium("heterogeneous", grid(name), {{"g.vol", bytes}}).messages();
  };
  EXPECT_THAT(messages(vol(1, 1, 2, 1, {-1, 2})),
              ElementsAre("warning: the values of sigma_t go from -1 to 2: those below 0 for 0 are taken"));
  EXPECT_THAT(messages(vol(1, 1, 2, 1, {0.5, 2}), "albedo"),
              ElementsAre("warning: the values of albedo go from 0.5 to 2: those above 1 for 1 are taken"));
  EXPECT_THAT(messages(vol(1, 1, 1, 1, {NAN})), ElementsAre(HasSubstr("error: the value at (0, 0, 0) is nan")));
  EXPECT_THAT(messages(vol(1, 1, 1, 2, {1, 1})), ElementsAre("error: a volume of 2 channels [1, 3 or 6 channels]"));
  EXPECT_THAT(messages(vol(100000, 100000, 100000, 3, {1})), ElementsAre(HasSubstr("do not fit")));
  EXPECT_THAT(messages(vol(1, 1, 1, 1, {1e30f})),
              ElementsAre("error: an extinction of 1e+30 per unit of length [up to 1e+15, with 'scale']"));
  EXPECT_THAT(messages("nothing"), ElementsAre(HasSubstr("no volume file")));
}

TEST(VolumeHost, AConstantFillsItsCube) {
  const Compiled c = compile_medium("heterogeneous", R"(<volume type="constvolume" name="sigma_t">
      <rgb name="value" value="0.5 0.25 0"/><transform name="to_world"><translate x="-0.5"/></transform></volume>)");
  EXPECT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(c.tables().media[0].lower, ElementsAre(-0.5f, 0.0f, 0.0f));
  EXPECT_THAT(c.tables().media[0].upper, ElementsAre(0.5f, 1.0f, 1.0f));
  EXPECT_THAT(c.tables().texels[c.tables().media[0].majorants], FloatEq(0.5f * (1 + 1e-6f)));
}

}  // namespace
}  // namespace norrsken::testing
