// Scenes as a whole; each plugin has its test beside it.
#include "compile/compile.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(Compile, AnEmptySceneNeedsASensor) {
  EXPECT_THAT(compile_elements("").messages(),
              ElementsAre("error: the scene has no sensor [<sensor type=\"perspective\">]"));
}

TEST(Compile, ASceneWithoutASensorIsLookedAtAsInMitsuba) {
  const std::string box = R"(<shape type="cube"><transform name="to_world"><scale x="1" y="2" z="3"/>
                             <translate x="1" y="2" z="3"/></transform></shape>)";
  const Compiled c = compile_elements(box + kEmitter);
  EXPECT_THAT(c.messages(), ElementsAre("note: the scene has no sensor: the picture is taken from (1, 2, -7.243) along "
                                        "+z, 45 degrees wide [a <sensor> for another one]"));
  // 7.2426407 is 6 / 2 / tan(22.5 degrees): as far away as the longest side, 6, is as wide as the view.
  const Compiled same = compile_elements(R"(<sensor type="perspective"><float name="fov" value="45"/>
      <float name="near_clip" value="0.072426407"/><float name="far_clip" value="37.2426407"/>
      <transform name="to_world"><translate x="1" y="2" z="-7.2426407"/></transform></sensor>)" +
                                         box + kEmitter);
  const CameraRecord &camera = c.tables().camera, &expected = same.tables().camera;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FLOAT_EQ(camera.origin[i], expected.origin[i]);
    EXPECT_FLOAT_EQ(camera.forward[i], expected.forward[i]);
  }
  EXPECT_FLOAT_EQ(camera.near_clip, expected.near_clip);
  EXPECT_FLOAT_EQ(camera.far_clip, expected.far_clip);
  EXPECT_EQ(c.tables().film.width, 768);
  EXPECT_EQ(c.tables().film.height, 576);
  EXPECT_EQ(c.info().sampler, "sobol");
  // Nothing to go by: from the origin.
  EXPECT_THAT(
      compile_elements(R"(<emitter type="constant"/>)").messages(),
      ElementsAre("note: the scene has no sensor: the picture is taken from (0, 0, 0) along +z, 45 degrees wide "
                  "[a <sensor> for another one]",
                  "warning: the scene has no shape"));
  LoadOptions options;
  options.sensor = "0";
  EXPECT_THAT(compile_elements(kShape + kEmitter, {}, options).messages(),
              ElementsAre("error: --sensor: the scene has no sensor '0' [no --sensor: the scene has none]"));
}

TEST(Compile, WhatNothingUsesNeedNotBeSupported) {
  const std::string scene = kSensor + kShape + kEmitter;
  EXPECT_THAT(compile_elements(scene + R"(<bsdf type="measured" id="fur"/>)").messages(),
              ElementsAre(StartsWith(
                  "warning: nothing uses 'fur', which is left out: bsdf 'measured' is not supported yet [")));
  EXPECT_THAT(compile_elements(scene + R"(<bsdf type="twosided"><bsdf type="difuse"/></bsdf>)").messages(),
              ElementsAre(StartsWith("warning: nothing uses this bsdf, which is left out: unknown bsdf "
                                     "'difuse', did you mean 'diffuse'? [")));
  EXPECT_THAT(compile_elements(scene + R"(<texture type="volume" id="t"/>)").messages(),
              ElementsAre(StartsWith("warning: nothing uses 't', which is left out: texture 'volume'")));
  const std::string group = R"(<shape type="shapegroup" id="g"><shape type="ellipsoids"/></shape>)";
  EXPECT_THAT(compile_elements(scene + group).messages(),
              ElementsAre(StartsWith("warning: nothing uses 'g', which is left out: shape 'ellipsoids'")));
  EXPECT_THAT(compile_elements(scene + R"(<medium type="homogeneous" id="m"><phase type="hg"/></medium>)").messages(),
              ElementsAre("warning: nothing refers to medium 'homogeneous', which has no effect by itself"));
  // What is used must be, however far behind.
  for (const std::string& used :
       {std::string(R"(<bsdf type="measured" id="fur"/><bsdf type="twosided" id="b"><ref id="fur"/></bsdf>)"
                    R"(<shape type="sphere"><ref id="b"/></shape>)"),
        group + R"(<shape type="instance"><ref id="g"/></shape>)",
        std::string(R"(<medium type="foggy" id="m"/><shape type="sphere"><ref id="m" name="interior"/></shape>)")})
    EXPECT_TRUE(compile_elements(scene + used).diagnostics.has_errors()) << used;
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
  EXPECT_THAT(c.messages(), ElementsAre("warning: only the scene's first sensor is used, this one is left aside "
                                        "[--sensor 1 for this one]"));
}

TEST(Compile, ASensorIsChosenByNumberOrId) {
  const auto with_sensor = [](const std::string& choice) {
    const auto sensor = [](const std::string& id, int width) {
      return fmt::format(R"(<sensor type="perspective"{}><film type="hdrfilm"><integer name="width" value="{}"/>
                            <rfilter type="box"/></film></sensor>)",
                         id.empty() ? "" : " id=\"" + id + "\"", width);
    };
    LoadOptions options;
    options.sensor = choice;
    return compile_elements(sensor("left", 10) + sensor("", 11) + sensor("1", 12) + kShape + kEmitter, {}, options);
  };
  for (const auto& [choice, width] : {std::pair{"0", 10}, {"left", 10}, {"1", 12}, {"2", 12}}) {
    const Compiled c = with_sensor(choice);
    EXPECT_THAT(c.messages(), IsEmpty()) << choice;
    EXPECT_EQ(c.tables().film.width, width) << choice << " (an id comes before a number)";
  }
  EXPECT_EQ(with_sensor("left").info().items.at(1).detail, "--sensor 0, the one that is used");
  // The number 1 is another one's id, and this one has none.
  EXPECT_EQ(with_sensor("left").info().items.at(2).detail, "--sensor 1");
  EXPECT_EQ(with_sensor("left").info().items.at(3).detail, "--sensor 2");
  EXPECT_THAT(
      with_sensor("lefft").messages(),
      ElementsAre("error: --sensor: the scene has no sensor 'lefft', did you mean 'left'? [0 or left, 1, 2 or 1]"));
  for (const char* choice : {"3", "-1", "", "0.5", "99999999999999999999"})
    EXPECT_FALSE(with_sensor(choice).scene) << choice;
}

TEST(Compile, SensorsAreNamedByWhatChoosesThem) {
  const auto sensor = [](const std::string& id) {
    return "<sensor type=\"perspective\" id=\"" + id +
           R"("><film type="hdrfilm"><rfilter type="box"/></film></sensor>)";
  };
  LoadOptions options;
  options.sensor = "9";
  EXPECT_THAT(compile_elements(sensor("1") + sensor("2") + sensor("3") + kShape + kEmitter, {}, options).messages(),
              ElementsAre("error: --sensor: the scene has no sensor '9' [0 or 1, 2, 3]"));
  const auto messages = compile_elements(sensor("1") + sensor("2") + sensor("0") + kShape + kEmitter).messages();
  EXPECT_THAT(messages, ElementsAre("warning: only the scene's first sensor is used, this one is left aside "
                                    "[--sensor 2 for this one]",
                                    "warning: only the scene's first sensor is used, this one is left aside "
                                    "[--sensor 0 for this one]"));
}

TEST(Compile, WhatIsInTheSceneToBeReferredToIsNoPartOfIt) {
  const std::string film = R"(<film type="hdrfilm" id="f"><integer name="width" value="7"/><ref id="r"/></film>)",
                    rest = R"(<rfilter type="box" id="r"/><sampler type="independent" id="s"/>)",
                    sensor = R"(<sensor type="perspective"><ref id="f"/><ref id="s"/></sensor>)";
  const Compiled c = compile_elements(sensor + film + rest + kShape + kEmitter);
  EXPECT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().film.width, 7);
  EXPECT_EQ(c.info().sampler, "independent");
  // Whatever the order, and below another node too.
  const Compiled other = compile_elements(rest + film + sensor + kShape + kEmitter);
  EXPECT_THAT(other.messages(), IsEmpty());
  EXPECT_THAT(compile_elements(kSensor + kShape + kEmitter + R"(<sampler type="sobol"/>)").messages(),
              ElementsAre("warning: nothing refers to sampler 'sobol', which has no effect by itself"));
}

TEST(Compile, AnAreaEmitterMayStandInTheSceneForItsShapes) {
  const std::string light = R"(<emitter type="area" id="l"/>)",
                    rectangle = R"(<shape type="rectangle"><ref id="l"/></shape>)";
  for (const std::string& scene : {light + rectangle, rectangle + light}) {
    const Compiled c = compile_elements(kSensor + scene);
    EXPECT_THAT(c.messages(), IsEmpty());
    EXPECT_EQ(c.tables().lights.size(), 1U);
  }
  EXPECT_THAT(compile_elements(kSensor + light + kShape + kEmitter).messages(),
              ElementsAre("warning: nothing refers to emitter 'area', which has no effect by itself"));
}

TEST(Compile, AnIntegratorMayBeReferredTo) {
  const Compiled c =
      compile_elements(kSensor + kShape + kEmitter +
                       R"(<integrator type="aov"><string name="aovs" value="d:depth"/><ref id="p"/></integrator>
         <integrator type="path" id="p"><integer name="max_depth" value="3"/></integrator>)");
  EXPECT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.info().max_depth, 3);
}

TEST(Compile, WhatAnErrorTookAwayIsNotMissing) {
  EXPECT_THAT(compile_elements(kSensor + R"(<shape type="sphere" type="cube"/>)").messages(),
              ElementsAre("error: attribute 'type' is given twice [each attribute once]"));
  EXPECT_THAT(compile_elements(R"(<sensor typ="perspective"/>)" + kShape + kEmitter).messages(),
              ElementsAre("error: <sensor> has no attribute 'typ', did you mean 'type'? [type, id, name]"));
}

TEST(Compile, RefusesWhatDoesNotBelongIntoAScene) {
  const std::string rest = kSensor + kShape + kEmitter;
  EXPECT_THAT(compile_elements(rest + R"(<integer name="width" value="4"/>)").messages(),
              ElementsAre("error: unused parameter 'width' of scene [no parameters]"));
}

TEST(Compile, BsdfsThatNobodyRefersToAreCheckedToo) {
  EXPECT_THAT(
      compile_elements(kSensor + kShape + kEmitter +
                       R"(<bsdf type="diffuse"><float name="rflectance" value="1"/></bsdf>)")
          .messages(),
      ElementsAre("error: unused parameter 'rflectance' of bsdf 'diffuse', did you mean 'reflectance'? [reflectance]"));
}

TEST(Compile, PluginsOfMitsuba0AreKnownByName) {
  for (const auto& [kind, plugin] : {std::pair{"bsdf", "phong"}, {"emitter", "sky"}, {"texture", "gridtexture"}}) {
    const Compiled c = compile_elements(kSensor + kShape + kEmitter + fmt::format("<{} type=\"{}\"/>", kind, plugin));
    ASSERT_EQ(c.messages().size(), 1U);
    EXPECT_THAT(c.messages()[0],
                ::testing::HasSubstr(fmt::format(": {} '{}' of Mitsuba 0.6 is not supported [", kind, plugin)));
  }
}

// What the reader makes of it stands in formats/mitsuba_upgrade_test.cpp; this is about what comes through.
TEST(Compile, AnOldSceneIsUpgraded) {
  const Compiled c = compile_files({{"scene.xml", R"(<scene version="0.5.0">
  <integrator type="bdpt"><integer name="maxDepth" value="7"/></integrator>
  <sensor type="perspective"><string name="fovAxis" value="smaller"/>
    <transform name="toWorld"><lookAt origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
    <sampler type="hammersley"><integer name="sampleCount" value="3"/></sampler>
    <film type="ldrfilm"><integer name="width" value="5"/><rfilter type="box"/></film></sensor>
  <shape type="sphere"><bsdf type="roughconductor"><float name="alphaU" value="0.2"/><float name="alphaV" value="0.3"/>
    <string name="material" value="Au"/></bsdf></shape>
  <emitter type="point"><point name="position" x="0" y="0" z="5"/></emitter>
</scene>)"}});
  EXPECT_THAT(c.messages(),
              ElementsAre("note: the scene is for Mitsuba '0.5.0' and was upgraded; 'norrsken info' tells how",
                          "warning: integrator 'bdpt' is 'path', which finds the same light in another way"));
  EXPECT_EQ(c.info().integrator, "path");
  EXPECT_EQ(c.info().max_depth, 7);
  EXPECT_EQ(c.info().samples_per_pixel, 3);
  EXPECT_EQ(c.info().width, 5);
  EXPECT_EQ(c.info().changes.size(), 10U);
  EXPECT_EQ(c.info().changes.at(0),
            "scene.xml:2:21: integrator 'bdpt' is 'path', which finds the same light in another way");

  const Compiled unknown =
      compile_files({{"scene.xml", R"(<scene version="0.5.0">)" + kSensor + kEmitter +
                                       R"(<shape type="sphere"><float name="raDius" value="2"/></shape></scene>)"}});
  EXPECT_THAT(unknown.messages(),
              ::testing::Contains(StartsWith("error: unused parameter 'raDius' of shape 'sphere', did you mean")));
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
