// Parameters of the emitters that are no surfaces: right, missing, wrong, unused; and what textures make of surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "compile/compile_testing.h"
#include "light/light_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::IsEmpty;

const Files kImages = {{"slide.hdr", radiance_file(4, 2, {8, {1, 2, 0.5}})},
                       {"tiny.hdr", radiance_file(2, 2, {4, {1, 1, 1}})},
                       {"map.hdr", radiance_file(4, 3, {12, {1, 2, 0.5}})}};
const std::string kSlide = R"( type="bitmap"><string name="filename" value="slide.hdr"/></texture>)";
const std::string kAttribute = R"( type="mesh_attribute"><string name="name" value="vertex_color"/></texture>)";

Compiled compile(const std::string& emitter) { return compile_elements(kSensor + kShape + emitter, kImages); }
Compiled compile_kind(const char* kind, const std::string& inside) {
  return compile(std::string("<emitter type=\"") + kind + "\">" + inside + "</emitter>");
}
std::vector<float> parameters_of(const Compiled& c, std::size_t count) {
  const auto first = c.tables().parameters.begin() + c.tables().lights.at(0).parameters;
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}
std::uint32_t word(float f) { return std::bit_cast<std::uint32_t>(f); }

TEST(SpotEmitter, HasMitsubasDefaults) {
  const Compiled c = compile_kind("spot", "");
  ASSERT_THAT(c.messages(), IsEmpty());
  const LightRecord& light = c.tables().lights.at(0);
  EXPECT_EQ(light.kind, LightKind::spot);
  EXPECT_THAT(light.emission, ElementsAre(1, 1, 1));
  EXPECT_THAT(light.normal, ElementsAre(0, 0, 1));
  const auto p = parameters_of(c, 6);
  const double degree = std::numbers::pi / 180;
  EXPECT_FLOAT_EQ(p[0], static_cast<float>(20 * degree));
  EXPECT_FLOAT_EQ(p[1], static_cast<float>(std::cos(20 * degree)));
  EXPECT_FLOAT_EQ(p[2], static_cast<float>(std::cos(15 * degree)));
  EXPECT_FLOAT_EQ(p[3], static_cast<float>(1 / (5 * degree)));
  EXPECT_EQ(word(p[5]), 0u);
}

TEST(SpotEmitter, HasIntensityAnglesTextureAndPlace) {
  const Compiled c = compile_kind(
      "spot", R"(<rgb name="intensity" value="1, 2, 3"/><float name="cutoff_angle" value="60"/>)"
              R"(<float name="beam_width" value="60"/><transform name="to_world"><scale value="2"/>)"
              R"(<lookat origin="1, 2, 3" target="1, 2, 2" up="0, 1, 0"/></transform><texture name="texture")" +
                  kSlide);
  ASSERT_THAT(c.messages(), IsEmpty());
  const LightRecord& light = c.tables().lights.at(0);
  EXPECT_THAT(light.emission, ElementsAre(1, 2, 3));
  EXPECT_THAT(light.origin, ElementsAre(1, 2, 3));
  EXPECT_THAT(light.normal, ElementsAre(FloatNear(0, 1e-6f), FloatNear(0, 1e-6f), FloatNear(-0.5f, 1e-6f)));
  const auto p = parameters_of(c, 6);
  EXPECT_EQ(p[3], 0);  // no edge
  EXPECT_FLOAT_EQ(p[4], static_cast<float>(1 / std::sqrt(3.0)));
  EXPECT_EQ(texture_kind(word(p[5])), TextureKind::bitmap);
}

TEST(SpotEmitter, RefusesWhatMakesNoSense) {
  EXPECT_THAT(compile_kind("spot", R"(<float name="cutoff_angle" value="180"/>)").messages(),
              ElementsAre("error: 'cutoff_angle' is 180 [a number above 0 and below 180]"));
  EXPECT_THAT(compile_kind("spot", R"(<float name="beam_width" value="25"/>)").messages(),
              ElementsAre("warning: 'beam_width' is 25, which is taken for 20 [a number from 0 to 20]"));
  EXPECT_THAT(compile_kind("spot", R"(<string name="beam_width" value="25"/>)").messages(),
              ElementsAre("error: 'beam_width' is a string [float]"));
  EXPECT_THAT(
      compile_kind("spot", R"(<float name="cutoff_angle" value="90"/><texture name="texture")" + kSlide).messages(),
      ElementsAre("error: 'cutoff_angle' is 90 with a texture [an angle below 90]"));
  EXPECT_THAT(compile_kind("spot", "<texture name=\"texture\"" + kAttribute).messages(),
              ElementsAre("error: 'texture' is an attribute of meshes [a texture that needs no mesh, such as bitmap]"));
  EXPECT_THAT(compile_kind("spot", R"(<float name="texture" value="1"/>)").messages(),
              ElementsAre("error: 'texture' is a float [a texture that differs from place to place, such as bitmap]"));
  EXPECT_THAT(compile_kind("spot", R"(<float name="cutoff" value="1"/>)").messages(),
              ElementsAre("error: unused parameter 'cutoff' of emitter 'spot' "
                          "[beam_width, cutoff_angle, intensity, sampling_weight, texture, to_world]"));
}

TEST(DirectionalEmitter, GoesAlongItsDirection) {
  const Compiled plain = compile_kind("directional", "");
  ASSERT_THAT(plain.messages(), IsEmpty());
  EXPECT_EQ(plain.tables().lights.at(0).kind, LightKind::directional);
  EXPECT_THAT(plain.tables().lights.at(0).normal, ElementsAre(0, 0, 1));
  EXPECT_THAT(plain.tables().lights.at(0).emission, ElementsAre(1, 1, 1));
  const Compiled c = compile_kind("directional", R"(<vector name="direction" x="0" y="-30" z="40"/>)"
                                                 R"(<rgb name="irradiance" value="1, 2, 3"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(c.tables().lights.at(0).normal, ElementsAre(0, -0.6f, 0.8f));
  EXPECT_THAT(c.tables().lights.at(0).emission, ElementsAre(1, 2, 3));
  const Compiled turned = compile_kind(
      "directional", R"(<transform name="to_world"><scale value="3"/><rotate x="1" angle="90"/></transform>)");
  ASSERT_THAT(turned.messages(), IsEmpty());
  EXPECT_THAT(turned.tables().lights.at(0).normal, ElementsAre(0, -1, FloatNear(0, 1e-6f)));
}

TEST(DirectionalEmitter, RefusesNoDirectionAndTwo) {
  EXPECT_THAT(compile_kind("directional", R"(<vector name="direction" x="0" y="0" z="0"/>)").messages(),
              ElementsAre("error: 'direction' is (0, 0, 0) [a vector with a length]"));
  EXPECT_THAT(compile_kind("directional", R"(<vector name="direction" x="1" y="0" z="0"/>)"
                                          R"(<transform name="to_world"><rotate x="1" angle="90"/></transform>)")
                  .messages(),
              ElementsAre("error: emitter 'directional' has both 'direction' and 'to_world' [one of them]"));
  EXPECT_THAT(compile_kind("directional", R"(<rgb name="irradiance" value="-1, 0, 0"/>)").messages(),
              ElementsAre("error: 'irradiance' is (-1, 0, 0) [components of at least 0]"));
  EXPECT_THAT(compile_kind("directional", R"(<float name="radiance" value="1"/>)").messages(),
              ElementsAre("error: unused parameter 'radiance' of emitter 'directional', did you mean 'irradiance'? "
                          "[direction, irradiance, sampling_weight, to_world]"));
}

TEST(ProjectorEmitter, HasScaleAndTheCamerasFieldOfView) {
  const Compiled c = compile_kind("projector", R"(<float name="fov" value="90"/><float name="scale" value="2"/>)"
                                               R"(<rgb name="irradiance" value="1, 0.5, 0"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const LightRecord& light = c.tables().lights.at(0);
  EXPECT_EQ(light.kind, LightKind::projector);
  const float pi2 = static_cast<float>(2 * std::numbers::pi);
  EXPECT_THAT(light.emission, ElementsAre(pi2, pi2 / 2, 0));
  EXPECT_THAT(parameters_of(c, 3), ElementsAre(FloatNear(1, 1e-6f), FloatNear(1, 1e-6f), 0));
}

TEST(ProjectorEmitter, TakesItsShapeFromTheTexture) {
  const Compiled c = compile_kind("projector", R"(<float name="fov" value="90"/><texture name="irradiance")" + kSlide);
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto p = parameters_of(c, 3);
  EXPECT_FLOAT_EQ(p[0], 1);
  EXPECT_FLOAT_EQ(p[1], 0.5f);
  EXPECT_EQ(texture_kind(word(p[2])), TextureKind::bitmap);
  EXPECT_FLOAT_EQ(c.tables().lights.at(0).emission[1], static_cast<float>(std::numbers::pi));
}

TEST(ProjectorEmitter, RefusesWhatMakesNoSense) {
  EXPECT_THAT(compile_kind("projector", R"(<float name="scale" value="-1"/>)").messages(),
              ElementsAre("error: 'scale' is -1 [a number of at least 0]"));
  EXPECT_THAT(compile_kind("projector", R"(<transform name="to_world"><scale value="2"/></transform>)").messages(),
              ElementsAre("error: 'to_world' of emitter 'projector' scales [translations, rotations and lookat]"));
  EXPECT_THAT(compile_kind("projector", R"(<float name="fov" value="180"/>)").messages(),
              ElementsAre("error: 'fov' is 180 [a number above 0 and below 180]"));
  EXPECT_THAT(compile_kind("projector", R"(<float name="width" value="1"/>)").messages(),
              ElementsAre("error: unused parameter 'width' of emitter 'projector' "
                          "[focal_length, fov, fov_axis, irradiance, sampling_weight, scale, to_world]"));
}

TEST(EnvmapEmitter, SurroundsTheScene) {
  const Compiled c =
      compile_kind("envmap", R"(<string name="filename" value="map.hdr"/><float name="scale" value="3"/>)"
                             R"(<boolean name="mis_compensation" value="true"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().lights.at(0).kind, LightKind::envmap);
  EXPECT_EQ(c.tables().environment, 0u);
  EXPECT_THAT(c.tables().lights.at(0).emission, ElementsAre(3, 3, 3));
}

/// What the density leaves out, the last of the kernel's parameters.
TEST(EnvmapEmitter, CompensatesWhereDirectionsCompete) {
  std::vector<std::array<double, 3>> texels(12, {1, 1, 1});
  texels[5] = {9, 9, 9};
  const auto darkest = [&](const std::string& integrator, const char* value, bool even = false) {
    const Compiled c = compile_elements(
        kSensor + kShape + integrator +
            R"(<emitter type="envmap"><string name="filename" value="sun.hdr"/><boolean name="mis_compensation" value=")" +
            value + R"("/></emitter>)",
        {{"sun.hdr", even ? radiance_file(4, 3, {12, {1, 1, 1}}) : radiance_file(4, 3, texels)}});
    EXPECT_THAT(c.messages(), IsEmpty());
    return double{parameters_of(c, 9)[8]};
  };
  // The equator's row weighs 1, each pole's the sine of a quarter of a row.
  const double pole = std::sin(std::numbers::pi / 8), mean = 1 + 8 / (4 * (1 + 2 * pole));
  EXPECT_NEAR(darkest("", "true"), mean, 1e-5);
  EXPECT_EQ(darkest("", "false"), 0);
  EXPECT_EQ(darkest("", "true", true), 0);  // hardly differs from its mean
  EXPECT_EQ(darkest(R"(<integrator type="ptracer"/>)", "true"), 0);
  EXPECT_EQ(darkest(R"(<integrator type="whitted"/>)", "true"), 0);
  EXPECT_EQ(darkest(R"(<integrator type="direct"><integer name="bsdf_samples" value="0"/>)"
                    R"(<integer name="emitter_samples" value="1"/></integrator>)",
                    "true"),
            0);
  EXPECT_THAT(compile_kind("envmap", R"(<string name="filename" value="map.hdr"/>)"
                                     R"(<float name="mis_compensation" value="1"/>)")
                  .messages(),
              ElementsAre("error: 'mis_compensation' is a float [boolean]"));
}

TEST(EnvmapEmitter, RefusesWhatMakesNoSense) {
  EXPECT_THAT(
      compile_kind("envmap", "").messages(),
      ElementsAre("error: emitter 'envmap' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
  EXPECT_THAT(compile_kind("envmap", R"(<string name="filename" value="tiny.hdr"/>)").messages(),
              ElementsAre("error: the image has 2 x 2 pixels [at least 2 x 3]"));
  EXPECT_THAT(
      compile_kind("envmap", R"(<string name="filename" value="map.hdr"/><float name="scale" value="-1"/>)").messages(),
      ElementsAre("error: 'scale' is -1 [a number of at least 0]"));
  EXPECT_THAT(
      compile_kind("envmap", R"(<string name="filename" value="map.hdr"/>)"
                             R"(<transform name="to_world"><scale x="2"/></transform>)")
          .messages(),
      ElementsAre(
          "error: 'to_world' of emitter 'envmap' distorts [translations, rotations and scales with one value]"));
  EXPECT_THAT(
      compile_kind("envmap", R"(<string name="filename" value="map.hdr"/><float name="gamma" value="1"/>)").messages(),
      ElementsAre("error: unused parameter 'gamma' of emitter 'envmap' [filename, mis_compensation, sampling_weight, "
                  "scale, to_world]"));
  const std::string map = R"(<emitter type="envmap"><string name="filename" value="map.hdr"/></emitter>)";
  EXPECT_THAT(compile(map + map).messages(),
              ElementsAre("error: the scene has more than one environment [one emitter that surrounds the scene]"));
}

/// As in Mitsuba: the emitter is where it would be outside, and the shape has the material of one that shines.
TEST(Emitters, ThatHaveNoSurfaceMayStandInAShape) {
  for (const char* kind : {"spot", "projector", "directional", "point"}) {
    const Compiled inside =
        compile_elements(kSensor + R"(<shape type="sphere"><emitter type=")" + kind + R"("/></shape>)");
    const Compiled outside = compile_elements(kSensor + kShape + R"(<emitter type=")" + kind + R"("/>)");
    EXPECT_THAT(inside.messages(), IsEmpty());
    ASSERT_EQ(inside.tables().lights.size(), 1u);
    EXPECT_EQ(inside.tables().lights[0].kind, outside.tables().lights[0].kind);
    EXPECT_THAT(inside.tables().lights[0].origin, ::testing::ElementsAreArray(outside.tables().lights[0].origin));
    EXPECT_EQ(inside.tables().light_of(0), kNone);
    EXPECT_EQ(inside.tables().surfaces.at(0).material_front, make_material(BsdfKind::absorb, 0));
  }
  EXPECT_THAT(compile_elements(kSensor + R"(<shape type="sphere"><emitter type="constant"/></shape>)").messages(),
              ElementsAre("error: emitter 'constant' surrounds the scene and cannot belong to a shape [area]"));
}

std::string weighted(const std::string& emitter, const std::string& weight) {
  return "<emitter type=\"" + emitter + "\"><float name=\"sampling_weight\" value=\"" + weight + "\"/></emitter>";
}

TEST(SamplingWeight, IsAFactorOnTheShareOfTheChoice) {
  const Compiled c = compile_elements(kSensor + kShape + weighted("point", "3") + weighted("point", "1"));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_FLOAT_EQ(c.tables().lights[0].prob, 0.75f);
  EXPECT_FLOAT_EQ(c.tables().lights[1].prob, 0.25f);
}

TEST(SamplingWeight, OfZeroLeavesAnAreaLightToTheRaysThatMeetIt) {
  const Compiled c = compile_elements(kSensor + kEmitter + "<shape type=\"sphere\">" + weighted("area", "0") +
                                      "</shape>" + weighted("constant", "0"));
  EXPECT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().lights[0].prob, 0);
  EXPECT_EQ(c.tables().lights[1].prob, 1);
  EXPECT_EQ(c.tables().lights[2].prob, 0);
}

TEST(SamplingWeight, OfZeroLosesWhatNoRayMeets) {
  const std::string lost =
      "' is lost: with a 'sampling_weight' of 0 it is not sampled, and nothing else finds it "
      "[a sampling_weight above 0]";
  EXPECT_THAT(compile_elements(kSensor + kShape + kEmitter + weighted("point", "0")).messages(),
              ElementsAre("warning: the light of emitter 'point" + lost));
  EXPECT_THAT(compile_elements(R"(<integrator type="ptracer"/>)" + kSensor + kEmitter + "<shape type=\"sphere\">" +
                               weighted("area", "0") + "</shape>")
                  .messages(),
              ElementsAre("warning: the light of emitter 'area" + lost));
  EXPECT_THAT(
      compile_elements(kSensor + "<shape type=\"sphere\">" + weighted("area", "0") + "</shape>").messages(),
      ElementsAre("error: every emitter has a sampling_weight of 0 [a sampling_weight above 0 for one of them]"));
}

TEST(DirectionalAreaEmitter, SaysThatNothingFindsIt) {
  const Compiled c = compile_elements(
      kSensor + kEmitter +
      R"(<shape type="rectangle"><emitter type="directionalarea"><float name="radiance" value="2"/></emitter></shape>)");
  EXPECT_THAT(c.messages(),
              ElementsAre("warning: the light of emitter 'directionalarea' cannot be found by paths from the "
                          "camera: it adds nothing to the image [integrator 'ptracer', whose paths begin at the "
                          "lights]"));
  ASSERT_EQ(c.tables().lights.size(), 2u);
  EXPECT_EQ(c.tables().lights[0].prob, 0);
  EXPECT_EQ(c.tables().lights[1].prob, 1);
  // It is an emitter that no ray sees shine.
  EXPECT_EQ(c.tables().light_of(0), 0u);
  EXPECT_EQ(c.tables().surfaces.at(0).material_front & kEmitsBit, 0u);
  EXPECT_THAT(compile_kind("directionalarea", "").messages(),
              ElementsAre("error: emitter 'directionalarea' stands outside of a shape "
                          "[a directionalarea emitter inside of the shape that shines]"));
  EXPECT_THAT(
      compile_elements(
          kSensor + kEmitter +
          R"(<shape type="rectangle"><emitter type="directionalarea"><float name="power" value="2"/></emitter></shape>)")
          .messages(),
      ::testing::Contains("error: unused parameter 'power' of emitter 'directionalarea' [radiance, sampling_weight]"));
}

TEST(DirectionalAreaEmitter, ShinesForPathsFromTheLights) {
  const auto light = [](const std::string& shape, const std::string& inside = {}) {
    const Compiled c = compile_elements(
        kSensor + R"(<integrator type="ptracer"/><shape type=")" + shape + R"(<emitter type="directionalarea">)" +
            (inside.empty() ? R"(<rgb name="radiance" value="1, 2, 3"/>)" : inside) + "</emitter></shape>",
        kImages);
    EXPECT_THAT(c.messages(), IsEmpty());
    return c.tables().lights.at(0);
  };
  EXPECT_EQ(light(R"(rectangle">)").kind, LightKind::parallelogram_normals);
  EXPECT_EQ(light(R"(sphere">)").kind, LightKind::sphere_normals);
  EXPECT_EQ(light(R"(disk">)").kind, LightKind::analytic_normals);
  EXPECT_EQ(light(R"(cube">)").prob, 1.0f / 6);
  EXPECT_THAT(light(R"(sphere">)").emission, ElementsAre(1, 2, 3));
  const LightRecord textured = light(R"(rectangle">)", "<texture name=\"radiance\"" + kSlide);
  EXPECT_THAT(textured.emission, ElementsAre(1, 2, 0.5f));
  EXPECT_NE(textured.parameters, kNone);
  EXPECT_THAT(compile_elements(kSensor + R"(<shape type="sphere"><emitter type="directionalarea">)"
                                         R"(<rgb name="radiance" value="-1, 0, 0"/></emitter></shape>)")
                  .messages(),
              ::testing::Contains("error: 'radiance' is (-1, 0, 0) [components of at least 0]"));
}

// --- textured surfaces -----------------------------------------------------------------------------------------------

TEST(TexturedAreaEmitter, ARectangleIsOneLightWithItsCoordinates) {
  const Compiled c = compile("<shape type=\"rectangle\"><emitter type=\"area\"><texture name=\"radiance\"" + kSlide +
                             "</emitter></shape>");
  ASSERT_THAT(c.messages(), IsEmpty());
  const LightRecord& light = c.tables().lights.at(0);
  EXPECT_EQ(light.kind, LightKind::parallelogram);
  EXPECT_THAT(light.emission, ElementsAre(1, 2, 0.5f));
  const auto p = parameters_of(c, 9);
  EXPECT_EQ(texture_kind(word(p[0])), TextureKind::bitmap);
  // The rectangle's coordinates go from 0 to 1 while its corners go from -1 to 1.
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_FLOAT_EQ(p[std::size_t(1 + axis)], (light.origin[axis] + 1) / 2);
    EXPECT_FLOAT_EQ(p[std::size_t(3 + axis)], light.edge1[axis] / 2);
    EXPECT_FLOAT_EQ(p[std::size_t(5 + axis)], light.edge2[axis] / 2);
  }
}

TEST(TexturedAreaEmitter, TrianglesOfOtherMapsStayApart) {
  const auto lights = [](const std::string& coordinates, const char* faces) {
    const Compiled c = compile_elements(
        kSensor +
            R"(<shape type="obj"><string name="filename" value="a.obj"/><emitter type="area"><texture name="radiance")" +
            kSlide + "</emitter></shape>",
        {{"slide.hdr", kImages.at("slide.hdr")},
         {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + coordinates + faces}});
    const auto no_texcoords = ::testing::HasSubstr("has no texture coordinates");
    EXPECT_THAT(c.messages(), coordinates.empty()
                                  ? ::testing::Matcher<std::vector<std::string>>(ElementsAre(no_texcoords))
                                  : IsEmpty());
    return c.tables().lights.size();
  };
  const char* mapped = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
  EXPECT_EQ(lights("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n", mapped), 1u);
  EXPECT_EQ(lights("vt 0 0\nvt 1 0\nvt 1 1\nvt 0.1 1\n", mapped), 2u);  // bent across the diagonal
  EXPECT_EQ(lights("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0\n", "f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n"), 2u);  // a seam
  EXPECT_EQ(lights("", "f 1 2 3\nf 1 3 4\n"), 2u);  // barycentric ones
}

TEST(TexturedAreaEmitter, RefusesNegativeLight) {
  EXPECT_THAT(compile(R"(<shape type="rectangle"><emitter type="area"><texture name="radiance" type="checkerboard">)"
                      R"(<rgb name="color0" value="-1, 0, 0"/></texture></emitter></shape>)")
                  .messages(),
              ::testing::Not(IsEmpty()));
}

}  // namespace
}  // namespace norrsken::testing
