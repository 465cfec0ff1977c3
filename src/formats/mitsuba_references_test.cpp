// What is said of parameters, files and ids that do not fit together.
#include <gtest/gtest.h>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

TEST(ParameterErrors, UndefinedParameter) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <default name="spp" value="4"/>
  <default name="light" value="area"/>
  <integer name="a" value="$ssp"/>
</scene>)"),
            R"(room.xml:4:28: error: undefined parameter '$ssp', did you mean '$spp'?
    4 |   <integer name="a" value="$ssp"/>
      |                            ^~~~
accepted: $spp, $light)");
}

TEST(ParameterErrors, NoParameterDefined) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <integer name="a" value="$spp"/>
</scene>)"),
            R"(room.xml:2:28: error: undefined parameter '$spp'
    2 |   <integer name="a" value="$spp"/>
      |                            ^~~~
accepted: a <default> before its use, or -Dspp=...)");
}

TEST(ParameterErrors, DollarWithoutAName) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <string name="a" value="5 $"/>
</scene>)"),
            R"(room.xml:2:27: error: '$' without the name of a parameter
    2 |   <string name="a" value="5 $"/>
      |                           ^~~
accepted: $ and letters, digits or _)");
}

TEST(ParameterErrors, UnusedOverride) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <default name="spp" value="4"/>
  <default name="unused" value="1"/>
  <integer name="a" value="$spp"/>
</scene>)",
                             {{"sp", "16"}, {"unused", "2"}}),
            R"(error: -Dsp: the scene does not use a parameter '$sp', did you mean 'spp'?
accepted: spp
error: -Dunused: the scene does not use a parameter '$unused'
accepted: spp)");
}

TEST(ParameterErrors, OverrideOfASceneWithoutParameters) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse"/>
</scene>)",
                             {{"spp", "16"}}),
            R"(error: -Dspp: the scene does not use a parameter '$spp'
accepted: no -D: the scene has no parameters)");
}

TEST(ParameterErrors, WrongValueFromTheCommandLine) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <default name="fov" value="45"/>
  <float name="fov" value="$fov"/>
</scene>)",
                             {{"fov", "wide"}}),
            R"(room.xml:3:28: error: 'wide' (from '$fov', set by -Dfov=wide) is not a number
    3 |   <float name="fov" value="$fov"/>
      |                            ^~~~
accepted: a number such as 1.5 or -2e3)");
}

TEST(ParameterErrors, NameThatCannotBeUsed) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <default name="my-fov" value="45"/>
</scene>)"),
            R"(room.xml:2:18: error: 'my-fov' cannot be the name of a parameter
    2 |   <default name="my-fov" value="45"/>
      |                  ^~~~~~
accepted: letters, digits and _)");
}

TEST(ParameterErrors, ValuesThatGrowWithoutMeasure) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <default name="a0" value="0123456789"/>
  <default name="a1" value="$a0$a0$a0$a0$a0$a0$a0$a0$a0$a0"/>
  <default name="a2" value="$a1$a1$a1$a1$a1$a1$a1$a1$a1$a1"/>
  <default name="a3" value="$a2$a2$a2$a2$a2$a2$a2$a2$a2$a2"/>
  <default name="a4" value="$a3$a3$a3$a3$a3$a3$a3$a3$a3$a3"/>
  <default name="a5" value="$a4$a4$a4$a4$a4$a4$a4$a4$a4$a4"/>
</scene>)"),
            R"(room.xml:6:29: error: the parameters make this value too long
    6 |   <default name="a4" value="$a3$a3$a3$a3$a3$a3$a3$a3$a3$a3"/>
      |                             ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
accepted: up to 64 KiB, and 64 MiB in all)");
}

TEST(FileErrors, MissingInclude) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <include filename="materials.xml"/>
</scene>)"),
            R"(room.xml:2:22: error: there is no file 'materials.xml'
    2 |   <include filename="materials.xml"/>
      |                      ^~~~~~~~~~~~~
accepted: a file in the current folder)");
}

TEST(FileErrors, IncludeThatIsAFolder) {
  EXPECT_EQ(complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0">
  <include filename="parts"/>
</scene>)"},
                                       {"parts/a.xml", ""}}),
            R"(room.xml:2:22: error: cannot read the included file 'parts': is a folder
    2 |   <include filename="parts"/>
      |                      ^~~~~
accepted: an XML file)");
}

TEST(FileErrors, IncludeOfItself) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <include filename="room.xml"/>
</scene>)"),
            R"(room.xml:2:22: error: the file includes itself: room.xml -> room.xml
    2 |   <include filename="room.xml"/>
      |                      ^~~~~~~~
accepted: a file that does not)");
}

TEST(FileErrors, IncludesInARing) {
  EXPECT_EQ(
      complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0">
  <include filename="parts/a.xml"/>
</scene>)"},
                                 {"parts/a.xml", R"(<scene version="3.0.0">
  <include filename="b.xml"/>
</scene>)"},
                                 {"parts/b.xml", R"(<scene version="3.0.0">
  <include filename="../parts/./a.xml"/>
</scene>)"}}),
      R"(parts/b.xml:2:22: error: the file includes itself: parts/a.xml -> parts/b.xml -> parts/a.xml (named at parts/a.xml:2:22)
    2 |   <include filename="../parts/./a.xml"/>
      |                      ^~~~~~~~~~~~~~~~
accepted: a file that does not)");
}

TEST(FileErrors, ErrorInAnIncludedFile) {
  EXPECT_EQ(complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0">
  <include filename="a.xml"/>
</scene>)"},
                                       {"a.xml", R"(<scene version="3.0.0">
  <bsfd/>
</scene>)"}}),
            R"(a.xml:2:3: error: unknown element 'bsfd', did you mean 'bsdf'? (named at room.xml:2:22)
    2 |   <bsfd/>
      |   ^~~~~
accepted: alias, boolean, bsdf, default, emitter, film, float, include, integer, integrator, medium, path, phase, point, ref, rfilter, rgb, sampler, sensor, shape, spectrum, string, texture, transform, vector, volume)");
}

TEST(FileErrors, IncludedFileWithAnotherRoot) {
  EXPECT_EQ(complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0">
  <include filename="a.xml"/>
</scene>)"},
                                       {"a.xml", "<materials/>"}}),
            R"(a.xml:1:1: error: the root element is <materials> (named at room.xml:2:22)
    1 | <materials/>
      | ^~~~~~~~~~
accepted: <scene>, or an object such as <bsdf>)");
}

TEST(FileErrors, IncludesTooDeep) {
  std::map<std::string, std::string> files{{"room.xml", R"(<scene version="3.0.0">
  <include filename="a0.xml"/>
</scene>)"}};
  for (int i = 0; i < 20; ++i)
    files["a" + std::to_string(i) + ".xml"] =
        "<scene version=\"3.0.0\"><include filename=\"a" + std::to_string(i + 1) + ".xml\"/></scene>";
  EXPECT_EQ(complaints_about(files),
            R"(a15.xml:1:43: error: too many includes (named at a14.xml:1:43)
    1 | <scene version="3.0.0"><include filename="a16.xml"/></scene>
      |                                           ^~~~~~~
accepted: up to 16 inside each other, 10000 in all)");
}

TEST(FileErrors, MissingFolder) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <path value="textures"/>
</scene>)"),
            R"(room.xml:2:16: error: there is no folder 'textures'
    2 |   <path value="textures"/>
      |                ^~~~~~~~
accepted: an existing folder, relative to this file)");
}

TEST(FileErrors, PathInsideOfAnObject) {
  EXPECT_EQ(complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0">
  <shape type="obj">
    <path value="parts"/>
  </shape>
</scene>)"},
                                       {"parts/a.obj", ""}}),
            R"(room.xml:3:5: error: <path> in a <shape>
    3 |     <path value="parts"/>
      |     ^~~~~
accepted: <path> in <scene>)");
}

TEST(ReferenceErrors, UnknownId) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse" id="white"/>
  <shape type="sphere">
    <ref id="whiet"/>
  </shape>
</scene>)"),
            R"(room.xml:4:14: error: nothing has the id 'whiet', did you mean 'white'?
    4 |     <ref id="whiet"/>
      |              ^~~~~
accepted: white)");
}

TEST(ReferenceErrors, NothingHasAnId) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <shape type="sphere">
    <ref id="white"/>
  </shape>
</scene>)"),
            R"(room.xml:3:14: error: nothing has the id 'white'
    3 |     <ref id="white"/>
      |              ^~~~~
accepted: an id of the scene, which has none)");
}

TEST(ReferenceErrors, IdTwice) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse" id="white"/>
  <bsdf type="diffuse" id="white"/>
</scene>)"),
            R"(room.xml:3:28: error: the id 'white' is already used at room.xml:2
    3 |   <bsdf type="diffuse" id="white"/>
      |                            ^~~~~
accepted: an id of its own)");
}

TEST(ReferenceErrors, CircleOfReferences) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="twosided" id="a">
    <ref id="b"/>
  </bsdf>
  <bsdf type="twosided" id="b">
    <ref id="a"/>
  </bsdf>
</scene>)"),
            R"(room.xml:6:14: error: this reference leads back to itself
    6 |     <ref id="a"/>
      |              ^
accepted: references without circles)");
}

TEST(ReferenceErrors, ReferenceToTheElementAround) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="twosided" id="a">
    <bsdf type="twosided">
      <ref id="a"/>
    </bsdf>
  </bsdf>
</scene>)"),
            R"(room.xml:4:16: error: this reference leads back to itself
    4 |       <ref id="a"/>
      |                ^
accepted: references without circles)");
}

TEST(ReferenceErrors, AliasOfNothing) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <alias id="white" as="paper"/>
</scene>)"),
            R"(room.xml:2:14: error: nothing has the id 'white'
    2 |   <alias id="white" as="paper"/>
      |              ^~~~~
accepted: an id of the scene, which has none)");
}

TEST(ReferenceErrors, AliasInACircle) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <alias id="a" as="b"/>
  <alias id="b" as="a"/>
  <ref id="a"/>
</scene>)"),
            R"(room.xml:2:14: error: nothing has the id 'a'
    2 |   <alias id="a" as="b"/>
      |              ^
accepted: an id of the scene, which has none
room.xml:3:14: error: nothing has the id 'b'
    3 |   <alias id="b" as="a"/>
      |              ^
accepted: an id of the scene, which has none)");
}

// Which sphere is found, by its radius: of the files of one name that there are in several places.
TEST(Includes, OfSeveralFilesTheOneThatMitsubaTakes) {
  const auto sphere = [](int radius) {
    return "<scene version=\"3.0.0\"><shape type=\"sphere\"><float name=\"radius\" value=\"" + std::to_string(radius) +
           "\"/></shape></scene>";
  };
  const auto radius = [](const TestFiles& files) {
    Diagnostics diagnostics;
    const auto scene = read_scene(files, {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics);
    return std::get<double>(scene->scene->children.at(0).node->properties.at(0).value);
  };
  const auto including = [](const std::string& file, const std::string& before = "") {
    return "<scene version=\"3.0.0\">" + before + "<include filename=\"" + file + "\"/></scene>";
  };
  // An included file's own folder comes first, then those of who includes it.
  TestFiles files{{"room.xml", including("sub/a.xml")}, {"sub/a.xml", including("b.xml")}, {"b.xml", sphere(1)}};
  EXPECT_EQ(radius(files), 1);
  files["sub/b.xml"] = sphere(2);
  EXPECT_EQ(radius(files), 2);
  EXPECT_EQ(complaints_about(files),
            R"(sub/a.xml:1:43: warning: 'b.xml' is 'sub/b.xml' here, and there is 'b.xml' too (named at room.xml:1:43)
    1 | <scene version="3.0.0"><include filename="b.xml"/></scene>
      |                                           ^~~~~)");
  // The last <path> comes before all others, and before the scene's folder.
  EXPECT_EQ(radius({{"room.xml", including("b.xml", R"(<path value="x"/><path value="y"/>)")},
                    {"b.xml", sphere(1)},
                    {"x/b.xml", sphere(2)},
                    {"y/b.xml", sphere(3)}}),
            3);
}

TEST(Includes, TheFoldersOfFilesThatAreNamedLater) {
  Diagnostics diagnostics;
  const auto scene = read_scene(
      TestFiles{{"dir/room.xml",
                 R"(<scene version="3.0.0"><path value="x"/><include filename="sub/a.xml"/><path value="y"/></scene>)"},
                {"room.xml",
                 R"(<scene version="3.0.0"><path value="x"/><include filename="sub/a.xml"/><path value="y"/></scene>)"},
                {"sub/a.xml", R"(<scene version="3.0.0"><path value="z"/></scene>)"},
                {"x/1", ""},
                {"y/1", ""},
                {"sub/z/1", ""}},
      {}, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  EXPECT_EQ(scene->search_paths, (std::vector<std::string>{"y", "x", "", "sub/z"}));
}

}  // namespace
}  // namespace norrsken
