// Scenes as a whole; each plugin has its test beside it.
#include "compile/compile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Compile, ASceneNeedsASensor) {
  EXPECT_THAT(compile_elements("").messages(),
              ElementsAre("error: the scene has no sensor [<sensor type=\"perspective\">]"));
}

TEST(Compile, AnEnvironmentAloneIsAScene) {
  const Compiled c = compile_elements(kSensor + R"(<emitter type="constant"/>)");
  EXPECT_TRUE(c.scene);
  EXPECT_THAT(c.messages(), ElementsAre("warning: the scene has no shape"));
  EXPECT_THAT(compile_elements(kSensor).messages(),
              ElementsAre("warning: the scene has no shape", "warning: the scene has no emitter: its image is black"));
}

TEST(Compile, WarnsOfWhatIsBeyondTheCamerasView) {
  const std::string sensor = R"(<sensor type="perspective"><float name="far_clip" value="100"/>)"
                             R"(<film type="hdrfilm"><rfilter type="box"/></film></sensor>)";
  const auto sphere_at = [](const std::string& z, const std::string& id) {
    return "<shape type=\"sphere\"" + id + "><point name=\"center\" x=\"0\" y=\"0\" z=\"" + z + "\"/></shape>\n";
  };
  // Near enough, behind the camera, and half of it in view.
  const std::string seen = sphere_at("50", "") + sphere_at("-500", "") + sphere_at("100.5", "");
  EXPECT_THAT(compile_elements(sensor + kEmitter + seen).messages(), IsEmpty());
  EXPECT_THAT(
      compile_elements(sensor + kEmitter + "\n" + seen + sphere_at("102", " id=\"far\"") + sphere_at("300", "") +
                       R"(<shape type="shapegroup" id="group">)" + sphere_at("0", "") + "</shape>" +
                       R"(<shape type="instance" id="copy"><ref id="group"/>)"
                       R"(<transform name="to_world"><translate z="200"/></transform></shape>)")
          .messages(),
      ElementsAre("warning: what is farther away than 'far_clip', 100, is not seen: 'far', a sphere in line 7, "
                  "'copy' [a far_clip of at least 301]"));
}

TEST(Compile, WarnsOfASceneWithoutLight) {
  const Compiled c = compile_elements(kSensor + kShape);
  EXPECT_TRUE(c.scene);
  EXPECT_THAT(c.messages(), ElementsAre("warning: the scene has no emitter: its image is black"));
}

TEST(Compile, WhatTheBaseClassesReadIsNotedOnce) {
  const std::string sensor = R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film>
    <float name="shutter_open" value="1"/>
    <integer name="focus_distance" value="5"/>
    <float name="focus_distanc" value="5"/>
    <string name="shutter_close" value="late"/></sensor>)";
  const std::string shape = R"(<shape type="sphere"><float name="silhouette_sampling_weight" value="2"/></shape>
)";
  EXPECT_THAT(compile_elements(sensor + kEmitter + shape + shape).messages(),
              ElementsAre("note: 'shutter_open' of a sensor has no effect here",
                          "note: 'focus_distance' of a sensor has no effect here (instead: sensor 'thinlens')",
                          "error: unused parameter 'focus_distanc' of sensor 'perspective', did you mean "
                          "'focus_distance'? [far_clip, focal_length, fov, fov_axis, near_clip, "
                          "principal_point_offset_x, principal_point_offset_y, to_world]",
                          "error: 'shutter_close' is a string [float]",
                          "note: 'silhouette_sampling_weight' of a shape has no effect here"));
}

TEST(Compile, TheFirstSensorIsUsed) {
  const Compiled c = compile_elements(
      R"(<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="10"/><rfilter type="box"/></film></sensor>)" +
      kSensor + kShape + kEmitter);
  EXPECT_EQ(c.tables().film.width, 10);
  EXPECT_THAT(c.messages(), ElementsAre("warning: only the scene's first sensor is used, this one is left aside"));
}

TEST(Compile, RefusesWhatDoesNotBelongIntoAScene) {
  const std::string rest = kSensor + kShape + kEmitter;
  EXPECT_THAT(compile_elements(rest + R"(<film type="hdrfilm"/>)").messages(),
              ElementsAre("error: unused film 'hdrfilm' in scene "
                          "[bsdf, emitter, integrator, sensor, shape, spectrum, texture]"));
  EXPECT_THAT(compile_elements(rest + R"(<volume type="gridvolume" id="t"/>)").messages(),
              ElementsAre("error: volume 'gridvolume' is not supported yet [a scene without volume]"));
  EXPECT_THAT(compile_elements(rest + R"(<integer name="width" value="4"/>)").messages(),
              ElementsAre("error: unused parameter 'width' of scene [no parameters]"));
}

TEST(Compile, BsdfsThatNobodyRefersToAreCheckedToo) {
  EXPECT_THAT(
      compile_elements(kSensor + kShape + kEmitter + R"(<bsdf type="hair" id="unused"/>)").messages(),
      ElementsAre("error: bsdf 'hair' is not supported yet [blendbsdf, bumpmap, conductor, dielectric, diffuse, "
                  "mask, normalmap, null, plastic, principled, principledthin, roughconductor, "
                  "roughdielectric, roughplastic, thindielectric, twosided]"));
}

TEST(Compile, TellsAllThatIsWrongInOneRun) {
  const Compiled c = compile_elements(R"(
    <integrator type="pth"/>
    <sensor type="perspective">
      <float name="fov" value="360"/>
      <sampler type="independent"><integer name="sample_count" value="0"/></sampler>
      <film type="hdrfilm"><integer name="width" value="10000000"/><rfilter type="box"/></film>
    </sensor>
    <shape type="sphere"><float name="radius" value="-1"/><bsdf type="difuse"/></shape>)");
  EXPECT_FALSE(c.scene);
  EXPECT_EQ(c.diagnostics.error_count(), 6);
}

TEST(Compile, InfoTellsWhatTheSceneContains) {
  const Compiled c = compile_elements(
      R"(<default name="n" value="3"/><integrator type="path"><integer name="max_depth" value="$n"/></integrator>)" +
      kSensor +
      R"(<bsdf type="diffuse" id="white"/><shape type="rectangle" id="floor"><ref id="white"/>)"
      R"(<emitter type="area"/></shape><shape type="sphere" id="ball"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneInfo& info = c.info();
  EXPECT_EQ(info.triangles, 2u);
  EXPECT_EQ(info.spheres, 1u);
  EXPECT_EQ(info.lights, 1u);
  EXPECT_EQ(info.max_depth, 3);
  EXPECT_EQ(info.rr_depth, 5);
  EXPECT_EQ(info.emitter_samples, 1);
  EXPECT_THAT(info.parameters, ElementsAre(std::pair<std::string, std::string>("n", "3")));
  EXPECT_GT(info.memory.tables(), 3 * sizeof(SurfaceRecord));
  EXPECT_LT(info.memory.tables(), 1000u);
  const auto item = [&](const std::string& id) {
    for (const auto& candidate : info.items) {
      if (candidate.id == id) return candidate.kind + " " + candidate.plugin + ": " + candidate.detail;
    }
    return std::string();
  };
  EXPECT_EQ(item("white"), "bsdf diffuse: reflectance 0.5 0.5 0.5");
  EXPECT_EQ(item("floor"), "shape rectangle: 2 triangles");
  EXPECT_EQ(item("ball"), "shape sphere: radius 1");
}

}  // namespace
}  // namespace norrsken::testing
