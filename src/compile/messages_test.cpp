// The complaints as a person reads them, to the letter: what was found, where, and what would have been accepted.
#include <gtest/gtest.h>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

/// All complaints about a scene of a sensor, a light (on lines 2 to 7) and `elements`.
std::string complaints(const std::string& elements, const Files& files = {}, const LoadOptions& options = {}) {
  const std::string rest =
      "  <sensor type=\"perspective\">\n"
      "    <film type=\"hdrfilm\">\n"
      "      <rfilter type=\"box\"/>\n"
      "    </film>\n"
      "  </sensor>\n"
      "  <emitter type=\"point\"/>\n";
  const Compiled compiled = compile_elements(rest + elements, files, options);
  std::string text;
  for (const Diagnostic& d : compiled.diagnostics.all()) text += to_text(d) + "\n";
  return text;
}

TEST(Messages, UnknownPlugin) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <bsdf type="difuse"/>
  </shape>)"),
            R"(scene.xml:9:17: error: unknown bsdf 'difuse', did you mean 'diffuse'?
    9 |     <bsdf type="difuse"/>
      |                 ^~~~~~
accepted: blendbsdf, bumpmap, conductor, dielectric, diffuse, gltf, hair, mask, normalmap, null, plastic, principled, principledthin, roughconductor, roughdielectric, roughplastic, thindielectric, twosided
)");
}

TEST(Messages, PluginToCome) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <bsdf type="measured"/>
  </shape>)"),
            R"(scene.xml:9:17: error: bsdf 'measured' is not supported yet
    9 |     <bsdf type="measured"/>
      |                 ^~~~~~~~
accepted: blendbsdf, bumpmap, conductor, dielectric, diffuse, gltf, hair, mask, normalmap, null, plastic, principled, principledthin, roughconductor, roughdielectric, roughplastic, thindielectric, twosided
)");
}

TEST(Messages, UnusedParameter) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <float name="raduis" value="2"/>
  </shape>)"),
            R"(scene.xml:9:18: error: unused parameter 'raduis' of shape 'sphere', did you mean 'radius'?
    9 |     <float name="raduis" value="2"/>
      |                  ^~~~~~
accepted: center, flip_normals, radius, to_world
)");
}

TEST(Messages, WrongType) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <string name="radius" value="big"/>
  </shape>)"),
            R"(scene.xml:9:34: error: 'radius' is a string
    9 |     <string name="radius" value="big"/>
      |                                  ^~~
accepted: float
)");
}

TEST(Messages, NotANumber) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <float name="radius" value="nan"/>
  </shape>)"),
            R"(scene.xml:9:33: error: 'nan' is not finite
    9 |     <float name="radius" value="nan"/>
      |                                 ^~~
accepted: a finite number
)");
}

TEST(Messages, MissingFile) {
  EXPECT_EQ(complaints(R"(  <shape type="obj">
    <string name="filename" value="missing.obj"/>
  </shape>)"),
            R"(scene.xml:9:36: error: there is no file 'missing.obj'
    9 |     <string name="filename" value="missing.obj"/>
      |                                    ^~~~~~~~~~~
accepted: a file in the current folder
)");
}

TEST(Messages, MissingFileName) {
  EXPECT_EQ(complaints(R"(  <shape type="obj"/>)"),
            R"(scene.xml:8:3: error: shape 'obj' needs a parameter 'filename'
    8 |   <shape type="obj"/>
      |   ^~~~~~
accepted: <string name="filename" value="..."/>
)");
}

TEST(Messages, OnlyTrianglesWithoutArea) {
  EXPECT_EQ(complaints(R"(  <shape type="obj">
    <string name="filename" value="line.obj"/>
  </shape>)",
                       {{"line.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n"}}),
            R"(scene.xml:9:36: warning: no triangle of the shape has an area, nothing of it is drawn
    9 |     <string name="filename" value="line.obj"/>
      |                                    ^~~~~~~~
)");
}

TEST(Messages, SomeTrianglesWithoutArea) {
  EXPECT_EQ(complaints(R"(  <shape type="obj">
    <string name="filename" value="a.obj"/>
  </shape>)",
                       {{"a.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 0 1 0\nf 1 2 3\nf 1 2 4\n"}}),
            R"(scene.xml:9:36: warning: 1 of 2 triangles has no area and is left out
    9 |     <string name="filename" value="a.obj"/>
      |                                    ^~~~~
)");
}

TEST(Messages, RectangleWithoutArea) {
  EXPECT_EQ(complaints(R"(  <shape type="rectangle">
    <transform name="to_world">
      <scale x="0"/>
    </transform>
  </shape>)"),
            R"(scene.xml:9:5: warning: no triangle of the shape has an area, nothing of it is drawn
    9 |     <transform name="to_world">
      |     ^~~~~~~~~~
)");
}

TEST(Messages, ShapeInAShape) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <shape type="sphere"/>
  </shape>)"),
            R"(scene.xml:9:5: error: unused shape 'sphere' in shape 'sphere'
    9 |     <shape type="sphere"/>
      |     ^~~~~~
accepted: bsdf, emitter, medium, sensor
)");
}

TEST(Messages, AreaEmitterOutsideOfAShape) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere"/>
  <emitter type="area"/>)"),
            R"(scene.xml:9:18: error: emitter 'area' stands outside of a shape
    9 |   <emitter type="area"/>
      |                  ^~~~
accepted: an area emitter inside of the shape that shines
)");
}

TEST(Messages, SecondSensor) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere"/>
  <sensor type="perspective"/>)"),
            R"(scene.xml:9:3: warning: only the scene's first sensor is used, this one is left aside
    9 |   <sensor type="perspective"/>
      |   ^~~~~~~
accepted: --sensor 1 for this one
)");
}

TEST(Messages, NoShape) {
  EXPECT_EQ(complaints(""),
            R"(scene.xml:1:1: warning: the scene has no shape
    1 | <scene version="3.0.0">
      | ^~~~~~
)");
}

TEST(Messages, OutOfRange) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <float name="radius" value="-1"/>
  </shape>)"),
            R"(scene.xml:9:33: error: 'radius' is -1
    9 |     <float name="radius" value="-1"/>
      |                                 ^~
accepted: a number of at least 0
)");
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <float name="radius" value="1e16"/>
  </shape>)"),
            R"(scene.xml:9:33: error: 'radius' is 1e+16
    9 |     <float name="radius" value="1e16"/>
      |                                 ^~~~
accepted: a number from 0 to 1e+12
)");
}

TEST(Messages, OutOfRangeThroughAParameter) {
  const std::string elements = R"(  <default name="size" value="-1"/>
  <shape type="sphere">
    <float name="radius" value="$size"/>
  </shape>)";
  EXPECT_EQ(complaints(elements),
            R"(scene.xml:10:33: error: 'radius' is -1 (from '$size')
   10 |     <float name="radius" value="$size"/>
      |                                 ^~~~~
accepted: a number of at least 0
)");
  LoadOptions options;
  options.parameters = {{"size", "-2"}};
  EXPECT_EQ(complaints(elements, {}, options),
            R"(scene.xml:10:33: error: 'radius' is -2 (from '$size', set by -Dsize=-2)
   10 |     <float name="radius" value="$size"/>
      |                                 ^~~~~
accepted: a number of at least 0
)");
}

TEST(Messages, OutOfRangeThroughADefaultMadeOfAnother) {
  const std::string elements = R"(  <default name="spp" value="1"/>
  <default name="rays" value="$spp"/>
  <integrator type="path">
    <integer name="emitter_samples" value="$rays"/>
  </integrator>
  <shape type="sphere"/>)";
  LoadOptions options;
  options.parameters = {{"spp", "0"}};
  EXPECT_EQ(complaints(elements, {}, options),
            R"(scene.xml:11:44: error: 'emitter_samples' is 0 (from '$rays', set by -Dspp=0)
   11 |     <integer name="emitter_samples" value="$rays"/>
      |                                            ^~~~~
accepted: an integer from 1 to 100000
)");
}

TEST(Messages, AMeshFileThatIsNone) {
  EXPECT_EQ(complaints(R"(  <shape type="obj">
    <string name="filename" value="empty.obj"/>
  </shape>
  <shape type="ply">
    <string name="filename" value="bad.ply"/>
  </shape>)",
                       {{"empty.obj", "# nothing\n"}, {"bad.ply", "\x01\x02"}}),
            R"(empty.obj: error: the file has no faces (named at scene.xml:9:36)
accepted: OBJ text with 'v' and 'f' lines
bad.ply: error: this is no PLY file (named at scene.xml:12:36)
accepted: a file whose first line is 'ply'
)");
}

TEST(Messages, AMeshFileThatIsAFolder) {
  EXPECT_EQ(complaints(R"(  <shape type="obj">
    <string name="filename" value="meshes"/>
  </shape>)",
                       {{"meshes/a.obj", ""}}),
            R"(scene.xml:9:36: error: cannot read 'meshes': is a folder
    9 |     <string name="filename" value="meshes"/>
      |                                    ^~~~~~
accepted: a readable obj file
)");
}

TEST(Messages, AnIncludedFileTellsWhereItWasNamed) {
  EXPECT_EQ(complaints("  <include filename=\"part.xml\"/>",
                       {{"part.xml", "<scene>\n  <shape type=\"sphre\"/>\n</scene>\n"}}),
            R"(part.xml:2:16: error: unknown shape 'sphre', did you mean 'sphere'? (named at scene.xml:8:22)
    2 |   <shape type="sphre"/>
      |                ^~~~~
accepted: bsplinecurve, cube, cylinder, disk, instance, linearcurve, mesh, obj, ply, rectangle, sdfgrid, serialized, shapegroup, sphere
)");
}

TEST(Messages, KindsToCome) {
  EXPECT_EQ(complaints(R"(  <shape type="sphere">
    <volume type="gridvolume"/>
  </shape>
  <volume type="gridvolume"/>)"),
            R"(scene.xml:9:5: error: a volume stands in shape 'sphere'
    9 |     <volume type="gridvolume"/>
      |     ^~~~~~~
accepted: a volume inside of a medium
scene.xml:11:3: warning: nothing refers to volume 'gridvolume', which has no effect by itself
   11 |   <volume type="gridvolume"/>
      |   ^~~~~~~
)");
}

TEST(Messages, SeveralInOneRun) {
  const Compiled c = compile_elements(R"(  <sensor type="perspective">
    <film type="hdrfilm">
      <integer name="width" value="10000000"/>
    </film>
    <sampler type="independent">
      <integer name="sample_count" value="0"/>
    </sampler>
  </sensor>
  <shape type="sphere"/>)");
  EXPECT_FALSE(c.scene);
  std::string text;
  for (const Diagnostic& d : c.diagnostics.all()) text += to_text(d) + "\n";
  EXPECT_EQ(text,
            R"(scene.xml:4:36: error: 'width' is 10000000
    4 |       <integer name="width" value="10000000"/>
      |                                    ^~~~~~~~
accepted: an integer from 1 to 65536
scene.xml:7:43: error: 'sample_count' is 0
    7 |       <integer name="sample_count" value="0"/>
      |                                           ^
accepted: an integer from 1 to 2147483647
)");
}

}  // namespace
}  // namespace norrsken::testing
