// What is said of elements and attributes that the format does not have.
#include <gtest/gtest.h>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

TEST(RootErrors, OtherRoot) {
  EXPECT_EQ(complaints_about(R"(<bsdf type="diffuse"/>)"),
            R"(room.xml:1:1: error: the root element is <bsdf>
    1 | <bsdf type="diffuse"/>
      | ^~~~~
accepted: <scene>)");
}

TEST(RootErrors, NoVersion) {
  EXPECT_EQ(complaints_about(R"(<scene>
</scene>)"),
            R"(room.xml:1:1: error: <scene> needs an attribute 'version'
    1 | <scene>
      | ^~~~~~
accepted: version="3.0.0", or that of the Mitsuba which the scene is for)");
}

TEST(RootErrors, NoSuchVersion) {
  EXPECT_EQ(complaints_about(R"(<scene version="new">
</scene>)"),
            R"(room.xml:1:17: error: 'new' is not a version
    1 | <scene version="new">
      |                 ^~~
accepted: a version such as 3.0.0)");
}

TEST(ElementErrors, UnknownElement) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsfd type="diffuse"/>
</scene>)"),
            R"(room.xml:2:3: error: unknown element 'bsfd', did you mean 'bsdf'?
    2 |   <bsfd type="diffuse"/>
      |   ^~~~~
accepted: alias, boolean, bsdf, default, emitter, film, float, include, integer, integrator, medium, path, phase, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector, volume)");
}

TEST(ElementErrors, UnknownElementUnlikeAny) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
	<material type="diffuse"/>
</scene>)"),
            R"(room.xml:2:2: error: unknown element 'material'
    2 |     <material type="diffuse"/>
      |     ^~~~~~~~~
accepted: alias, boolean, bsdf, default, emitter, film, float, include, integer, integrator, medium, path, phase, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector, volume)");
}

TEST(ElementErrors, UnknownAttribute) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov" vlaue="45"/>
</scene>)"),
            R"(room.xml:2:21: error: <float> has no attribute 'vlaue', did you mean 'value'?
    2 |   <float name="fov" vlaue="45"/>
      |                     ^~~~~
accepted: name, value)");
}

TEST(ElementErrors, MissingAttributes) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float value="45"/>
  <bsdf id="a"/>
  <float name="fov"/>
</scene>)"),
            R"(room.xml:2:3: error: <float> needs an attribute 'name'
    2 |   <float value="45"/>
      |   ^~~~~~
accepted: name, value
room.xml:3:3: error: <bsdf> needs an attribute 'type'
    3 |   <bsdf id="a"/>
      |   ^~~~~
accepted: type, id, name
room.xml:4:3: error: <float> needs an attribute 'value'
    4 |   <float name="fov"/>
      |   ^~~~~~
accepted: name, value)");
}

TEST(ElementErrors, RepeatedAttribute) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="a" name="b" value="1"/>
</scene>)"),
            R"(room.xml:2:19: error: attribute 'name' is given twice
    2 |   <float name="a" name="b" value="1"/>
      |                   ^~~~
accepted: each attribute once)");
}

TEST(ElementErrors, RepeatedName) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <sensor type="perspective">
    <float name="fov" value="45"/>
    <integer name="fov" value="50"/>
  </sensor>
</scene>)"),
            R"(room.xml:4:20: error: 'fov' is already given in line 3
    4 |     <integer name="fov" value="50"/>
      |                    ^~~
accepted: each name once)");
}

TEST(ElementErrors, RepeatedNameOfAChild) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse">
    <rgb name="reflectance" value="1"/>
    <texture name="reflectance" type="bitmap"/>
  </bsdf>
</scene>)"),
            R"(room.xml:4:20: error: 'reflectance' is already given in line 3
    4 |     <texture name="reflectance" type="bitmap"/>
      |                    ^~~~~~~~~~~
accepted: each name once)");
}

TEST(ElementErrors, TextInAnElement) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse"> hello </bsdf>
</scene>)"),
            R"(room.xml:2:25: error: text in <bsdf>
    2 |   <bsdf type="diffuse"> hello </bsdf>
      |                         ^~~~~
accepted: elements)");
}

TEST(ElementErrors, ContentsOfAValue) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov" value="45"><float name="a" value="1"/></float>
</scene>)"),
            R"(room.xml:2:32: error: <float> has contents
    2 |   <float name="fov" value="45"><float name="a" value="1"/></float>
      |                                ^~~~~~
accepted: <float .../>)");
}

TEST(ElementErrors, SceneInAScene) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <scene version="3.0.0"/>
</scene>)"),
            R"(room.xml:2:3: error: <scene> inside of another element
    2 |   <scene version="3.0.0"/>
      |   ^~~~~~
accepted: alias, boolean, bsdf, default, emitter, film, float, include, integer, integrator, medium, path, phase, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector, volume)");
}

TEST(ElementErrors, StepOutsideOfATransform) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <translate x="1"/>
</scene>)"),
            R"(room.xml:2:3: error: <translate> outside of a <transform>
    2 |   <translate x="1"/>
      |   ^~~~~~~~~~
accepted: alias, boolean, bsdf, default, emitter, film, float, include, integer, integrator, medium, path, phase, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector, volume)");
}

TEST(ElementErrors, Animation) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <animation name="to_world"/>
</scene>)"),
            R"(room.xml:2:3: error: <animation> is not supported
    2 |   <animation name="to_world"/>
      |   ^~~~~~~~~~
accepted: alias, boolean, bsdf, default, emitter, film, float, include, integer, integrator, medium, path, phase, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector, volume)");
}

TEST(ElementErrors, SeveralErrorsInOneRun) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf tpye="diffuse"/>
  <sensor type="perspective">
    <float name="fov" value="abc"/>
    <ref id="missing"/>
  </sensor>
</scene>)"),
            R"(room.xml:2:9: error: <bsdf> has no attribute 'tpye', did you mean 'type'?
    2 |   <bsdf tpye="diffuse"/>
      |         ^~~~
accepted: type, id, name
room.xml:4:30: error: 'abc' is not a number
    4 |     <float name="fov" value="abc"/>
      |                              ^~~
accepted: a number such as 1.5 or -2e3
room.xml:5:14: error: nothing has the id 'missing'
    5 |     <ref id="missing"/>
      |              ^~~~~~~
accepted: an id of the scene, which has none)");
}

TEST(MitsubaElement, APathIsAFolder) {
  EXPECT_EQ(complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0">
  <path value="a.obj"/>
</scene>)"},
                                       {"a.obj", ""}}),
            R"(room.xml:2:16: error: 'a.obj' is not a folder
    2 |   <path value="a.obj"/>
      |                ^~~~~
accepted: an existing folder, relative to this file)");
}

TEST(MitsubaElement, WarnsOfNewerVersions) {
  EXPECT_EQ(complaints_about(R"(<scene version="4.1.0"/>)"),
            R"(room.xml:1:17: warning: the scene is for Mitsuba '4.1.0', which may mean other things
    1 | <scene version="4.1.0"/>
      |                 ^~~~~
accepted: 0.x to 3.x)");
}

}  // namespace
}  // namespace norrsken
