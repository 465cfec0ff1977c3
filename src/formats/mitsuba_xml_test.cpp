// What comes out of scene files that are right.
#include "formats/mitsuba_xml.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ctime>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "formats/reader_testing.h"
#include "scene/memory_files.h"

namespace norrsken {
namespace {

// A scene around `body`, which must be read without a complaint.
Description read(const std::string& body, const TestParameters& parameters = {}, TestFiles files = {}) {
  files["room.xml"] = "<scene version=\"3.0.0\">\n" + body + "\n</scene>";
  Diagnostics diagnostics;
  auto description = read_scene(files, parameters, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  if (!description) throw std::runtime_error("no description");
  return std::move(*description);
}

template <typename Value>
Value value_of(const Description& description, const std::string& name) {
  for (const Property& property : description.scene->properties) {
    if (property.name == name) return std::get<Value>(property.value);
  }
  throw std::runtime_error("no property " + name);
}

glm::dvec3 apply(const std::string& steps, glm::dvec3 point) {
  const glm::dmat4 matrix =
      to_glm(value_of<Property::Transform>(read("<transform name=\"t\">" + steps + "</transform>"), "t"));
  return glm::dvec3(matrix * glm::dvec4(point, 1));
}

void expect_near(glm::dvec3 a, glm::dvec3 b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12) << "component " << i;
}

TEST(MitsubaXml, Values) {
  const Description scene = read(R"(
    <boolean name="on" value="true"/>
    <boolean name="off" value="False"/>
    <integer name="i" value="-12"/>
    <float name="f" value=" 1.5e3 "/>
    <float name="whole" value="2"/>
    <string name="s" value="a &lt; b &amp; &#xe5;"/>
    <string name="empty" value=""/>
    <point name="p" value="1, 2,3"/>
    <point name="xyz" x="1" y="2" z="3"/>
    <vector name="v" value="4"/>)");
  EXPECT_TRUE(value_of<bool>(scene, "on"));
  EXPECT_FALSE(value_of<bool>(scene, "off"));
  EXPECT_EQ(value_of<std::int64_t>(scene, "i"), -12);
  EXPECT_EQ(value_of<double>(scene, "f"), 1500);
  EXPECT_EQ(value_of<double>(scene, "whole"), 2) << "a float stays a float";
  EXPECT_EQ(value_of<std::string>(scene, "s"), "a < b & \xC3\xA5");
  EXPECT_EQ(value_of<std::string>(scene, "empty"), "");
  EXPECT_EQ(to_glm(value_of<Property::Vector>(scene, "p").value), glm::dvec3(1, 2, 3));
  EXPECT_EQ(to_glm(value_of<Property::Vector>(scene, "xyz").value), glm::dvec3(1, 2, 3));
  EXPECT_EQ(to_glm(value_of<Property::Vector>(scene, "v").value), glm::dvec3(4));
}

TEST(MitsubaXml, ColorsAndSpectra) {
  const Description scene = read(R"(
    <rgb name="rgb" value="0.1, 0.2 0.3"/>
    <rgb name="grey" value="0.5"/>
    <rgb name="hex" value="#FF8000"/>
    <spectrum name="constant" value="0.25"/>
    <spectrum name="pairs" value="400:0.1, 500:.2 600:3e-1"/>
    <spectrum name="file" filename="data/measured.spd"/>)",
                                 {}, {{"data/measured.spd", "# nm value\r\n\n400 0.5 # first\n  500\t0.75"}});
  EXPECT_EQ(to_glm(value_of<Property::Rgb>(scene, "rgb").value), glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(to_glm(value_of<Property::Rgb>(scene, "grey").value), glm::dvec3(0.5));
  expect_near(to_glm(value_of<Property::Rgb>(scene, "hex").value), {1, 0.21586050011389926, 0});  // sRGB, decoded
  using Samples = std::vector<std::pair<double, double>>;
  EXPECT_EQ(value_of<Property::Spectrum>(scene, "constant").samples, (Samples{{0, 0.25}}));
  EXPECT_EQ(value_of<Property::Spectrum>(scene, "pairs").samples, (Samples{{400, 0.1}, {500, 0.2}, {600, 0.3}}));
  EXPECT_EQ(value_of<Property::Spectrum>(scene, "file").samples, (Samples{{400, 0.5}, {500, 0.75}}));
}

TEST(MitsubaXml, TransformSteps) {
  expect_near(apply(R"(<translate value="1 2 3"/>)", {10, 10, 10}), {11, 12, 13});
  expect_near(apply(R"(<translate y="2"/>)", {10, 10, 10}), {10, 12, 10});
  expect_near(apply(R"(<scale value="2"/>)", {1, 2, 3}), {2, 4, 6});
  expect_near(apply(R"(<scale x="2"/>)", {1, 2, 3}), {2, 2, 3});
  expect_near(apply(R"(<rotate z="1" angle="90"/>)", {1, 0, 0}), {0, 1, 0});
  expect_near(
      apply(R"(<rotate value="0.57735026918962576 0.57735026918962576 0.57735026918962576" angle="120"/>)", {1, 0, 0}),
      {0, 1, 0});
  expect_near(apply(R"(<matrix value="1 2 3 4  5 6 7 8  9 10 11 12  0 0 0 1"/>)", {1, 0, 0}), {5, 13, 21});
  expect_near(apply(R"(<matrix value="1 2 3  4 5 6  7 8 9"/>)", {0, 1, 0}), {2, 5, 8});
}

TEST(MitsubaXml, TheFirstStepIsAppliedFirst) {
  expect_near(apply(R"(<scale value="2"/><translate x="1"/>)", {1, 0, 0}), {3, 0, 0});
  expect_near(apply(R"(<translate x="1"/><scale value="2"/>)", {1, 0, 0}), {4, 0, 0});
}

// Columns are what becomes of x, y and z. The numbers are those that Mitsuba 3.9.1 gives for the same files.
TEST(MitsubaXml, LookAtWithoutUpRollsAsMitsubaDoes) {
  struct View {
    const char* target;
    glm::dvec3 x, y;
  };
  const View views[] = {
      {"1 0 0", {0, -1, 0}, {0, 0, -1}},
      {"-1 0 0", {0, -1, 0}, {0, 0, 1}},
      {"0 1 0", {0, 0, 1}, {1, 0, 0}},
      {"0 -1 0", {0, 0, -1}, {1, 0, 0}},
      {"0 0 1", {0, -1, 0}, {1, 0, 0}},
      {"0 0 -1", {0, 1, 0}, {1, 0, 0}},
      {"1 2 3", {0.079287, -0.841427, 0.534522}, {0.960357, -0.079287, -0.267261}},
      {"-2 1 -0.5", {0.312713, 0.843644, 0.436436}, {0.374574, 0.312713, -0.872872}},
      {"0.3 -0.7 -2", {0.023702, 0.944696, -0.327088}, {0.989842, 0.023702, 0.140181}},
      {"2 2.5 -2.5", {-0.187582, 0.765523, 0.615458}, {0.849935, -0.187582, 0.492366}},
  };
  for (const View& view : views) {
    for (const char* up : {"", "up=\"0 0 0\"", "up=\"0, -0, 0\""}) {
      SCOPED_TRACE(fmt::format("target {} {}", view.target, up));
      const std::string steps = fmt::format("<lookat origin=\"0 0 0\" target=\"{}\" {}/>", view.target, up);
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(apply(steps, {1, 0, 0})[i], view.x[i], 1e-6);
        EXPECT_NEAR(apply(steps, {0, 1, 0})[i], view.y[i], 1e-6);
      }
    }
  }
}

TEST(MitsubaXml, LookAtMapsTheCameraAxes) {
  const std::string steps = R"(<lookat origin="-1 0 0" target="4 0 0" up="0 0 1"/>)";
  expect_near(apply(steps, {0, 0, 0}), {-1, 0, 0});
  expect_near(apply(steps, {0, 0, 1}), {0, 0, 0});   // forward is +x
  expect_near(apply(steps, {0, 1, 0}), {-1, 0, 1});  // up is +z
  expect_near(apply(steps, {1, 0, 0}), {-1, 1, 0});  // left, seen along +x with z up, is +y
  EXPECT_EQ(apply(steps, {1, 2, 3}), apply(R"(<look_at origin="-1,0,0" target="4,0,0" up="0,0,1"/>)", {1, 2, 3}));
  expect_near(apply(R"(<lookat origin="1 2 3" target="1 2 8"/>)", {0, 0, 2}), {1, 2, 5});
}

TEST(MitsubaXml, ObjectsNestAndKeepTheirOrder) {
  const Description scene = read(R"(
    <sensor type="perspective" id="camera"><float name="fov" value="45"/><film type="hdrfilm"/></sensor>
    <shape type="sphere"><bsdf type="diffuse" name="inside"><spectrum type="d65" name="reflectance"/></bsdf></shape>)");
  ASSERT_EQ(scene.scene->children.size(), 2u);
  const Node& sensor = *scene.scene->children[0].node;
  EXPECT_EQ(sensor.kind, "sensor");
  EXPECT_EQ(sensor.plugin, "perspective");
  EXPECT_EQ(sensor.id, "camera");
  EXPECT_EQ(sensor.location.line, 3);
  EXPECT_EQ(sensor.location.column, 5);
  EXPECT_EQ(sensor.plugin_location.column, 19);
  ASSERT_EQ(sensor.properties.size(), 1u);
  EXPECT_EQ(sensor.properties[0].name, "fov");
  EXPECT_EQ(sensor.properties[0].type, "float");
  EXPECT_EQ(sensor.properties[0].location.column, 69);
  EXPECT_EQ(sensor.properties[0].name_location.column, 57);
  EXPECT_EQ(sensor.children.at(0).node->kind, "film");
  const Node::Child& bsdf = scene.scene->children[1].node->children.at(0);
  EXPECT_EQ(bsdf.name, "inside");
  EXPECT_EQ(bsdf.node->name, "inside");
  EXPECT_EQ(bsdf.node->children.at(0).node->kind, "spectrum") << "with a type it is a plugin";
}

TEST(MitsubaXml, ReferencesShareTheNodeAlsoForward) {
  const Description scene = read(R"(
    <shape type="sphere"><ref id="paper" name="bsdf"/><emitter type="area"/></shape>
    <shape type="cube"><ref id="white"/></shape>
    <alias id="white" as="paper"/>
    <bsdf type="diffuse" id="white"/>)");
  const auto& children = scene.scene->children;
  ASSERT_EQ(children.size(), 3u);
  const Node::Child& use = children[0].node->children.at(0);
  EXPECT_EQ(use.name, "bsdf");
  EXPECT_EQ(use.location.line, 3);
  EXPECT_EQ(use.node, children[2].node);
  EXPECT_EQ(children[0].node->children.at(1).node->kind, "emitter");
  EXPECT_EQ(children[1].node->children.at(0).node, children[2].node);
}

TEST(MitsubaXml, ParametersAreFilledInEverywhere) {
  const std::string body = R"(
    <default name="kind" value="diffuse"/>
    <default name="size" value="2"/>
    <default name="twice" value="$size, $size"/>
    <default name="size" value="7"/>
    <bsdf type="$kind" id="my_$kind"/>
    <string name="s" value="$size-$twice$kind"/>
    <float name="only_given" value="$given"/>)";
  const Description plain = read(body, {{"given", "1"}});
  EXPECT_EQ(plain.scene->children[0].node->plugin, "diffuse");
  EXPECT_EQ(plain.scene->children[0].node->id, "my_diffuse");
  EXPECT_EQ(value_of<std::string>(plain, "s"), "2-2, 2diffuse") << "the first default counts";
  using Values = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(plain.parameters, (Values{{"kind", "diffuse"}, {"size", "2"}, {"twice", "2, 2"}, {"given", "1"}}));

  const Description given = read(body, {{"size", "3"}, {"given", "1"}, {"size", "5"}, {"kind", "a$b"}});
  EXPECT_EQ(value_of<std::string>(given, "s"), "5-5, 5a$b") << "the last -D counts, and is taken as it is";
}

TEST(MitsubaXml, IncludesAreSplicedIn) {
  const Description scene = read(R"(
    <default name="light" value="area"/>
    <path value="lib"/>
    <include filename="parts/light_$light.xml"/>
    <include filename="metal.xml"/>
    <shape type="sphere"><include filename="parts/bsdf.xml"/></shape>)",
                                 {},
                                 {{"parts/light_area.xml",
                                   R"(<scene version="3.0.0">
  <default name="power" value="10"/>
  <emitter type="$light"><include filename="radiance.xml"/></emitter>
</scene>)"},
                                  {"parts/radiance.xml", R"(<scene><float name="radiance" value="$power"/></scene>)"},
                                  {"lib/metal.xml", R"(<scene version="3.0.0"><bsdf type="conductor"/></scene>)"},
                                  {"parts/bsdf.xml", R"(<bsdf type="diffuse"/>)"}});
  ASSERT_EQ(scene.scene->children.size(), 3u);
  const Node& emitter = *scene.scene->children[0].node;
  EXPECT_EQ(emitter.plugin, "area");
  EXPECT_EQ(emitter.location.file, "parts/light_area.xml");
  EXPECT_EQ(emitter.properties.at(0).location.file, "parts/radiance.xml");
  EXPECT_EQ(std::get<double>(emitter.properties.at(0).value), 10);
  EXPECT_EQ(scene.scene->children[1].node->plugin, "conductor");
  EXPECT_EQ(scene.scene->children[2].node->children.at(0).node->plugin, "diffuse");
  EXPECT_EQ(scene.search_paths, (std::vector<std::string>{"lib", ""}))
      << "a <path> comes before the scene's own folder";
}

TEST(MitsubaXml, OneFileMayBeIncludedTwice) {
  const Description scene = read(R"(<include filename="a.xml"/><include filename="a.xml"/>)", {},
                                 {{"a.xml", R"(<scene version="3.0.0"><shape type="sphere"/></scene>)"}});
  EXPECT_EQ(scene.scene->children.size(), 2u);
}

TEST(MitsubaXml, ByteOrderMarkAndDeclarationAreFine) {
  Diagnostics diagnostics;
  const auto scene = read_scene(
      "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!DOCTYPE scene>\n"
      "<!-- a scene --><scene version='3.0.0'>\r\n<bsdf\r\ntype = 'diffuse'/></scene>\n",
      {}, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  ASSERT_TRUE(scene.has_value());
  EXPECT_EQ(scene->scene->children.at(0).node->plugin_location.line, 5);
  EXPECT_EQ(scene->scene->children.at(0).node->plugin_location.column, 9);
}

TEST(MitsubaXml, GoesOnAfterWrongValuesAndTellsWhichTheyWere) {
  Diagnostics diagnostics;
  const auto scene = read_scene(R"(<scene version="3.0.0"><sensor type="perspective">
    <float name="fov" value="abc"/><float name="near_clip" value="1"/></sensor><bsdf/></scene>)",
                                {}, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 2);
  ASSERT_TRUE(scene.has_value());
  ASSERT_EQ(scene->scene->children.size(), 1u) << "what has no type is left out";
  const Node& sensor = *scene->scene->children[0].node;
  EXPECT_EQ(sensor.unreadable, std::vector<std::string>{"fov"});
  EXPECT_EQ(sensor.properties.at(0).name, "near_clip");
}

TEST(MitsubaXml, TellsNothingOfAScenePartlyKnown) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_scene(R"(<scene version="3.0.0"><include filename="missing.xml"/></scene>)", {}, diagnostics));
  EXPECT_FALSE(read_scene(R"(<scene version="3.0.0">)", {}, diagnostics));
  EXPECT_FALSE(read_scene(TestFiles{}, {}, diagnostics));
  EXPECT_EQ(to_text(diagnostics.all().back()),
            "error: cannot read the scene 'room.xml': no such file\naccepted: an XML file");
}

// --- what a file could do to the reader ---

std::string repeat(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

std::string first_message(const std::string& xml) {
  Diagnostics diagnostics;
  read_scene(xml, {}, diagnostics);
  return diagnostics.all().empty() ? "" : diagnostics.all()[0].message;
}

TEST(HostileXml, DeepNestingIsRefusedAndCostsNoStack) {
  const int depth = 200000;
  EXPECT_EQ(first_message("<scene version=\"3.0.0\">" + repeat("<shape type=\"a\">", depth) +
                          repeat("</shape>", depth) + "</scene>"),
            "elements are nested more than 100 deep");
  EXPECT_EQ(first_message("<scene version=\"3.0.0\">" + repeat("<shape type=\"a\">", depth)),
            "<shape> is never closed");
  EXPECT_EQ(first_message("<scene version=\"3.0.0\">" + repeat("<shape type=\"a\">", 99) + repeat("</shape>", 99) +
                          "</scene>"),
            "");
}

TEST(HostileXml, ChainsOfReferencesAreBounded) {
  // Each refers to the one before: as nodes that own each other they would be destroyed one inside the other.
  std::string xml = "<scene version=\"3.0.0\"><bsdf type=\"a\" id=\"b0\"/>";
  for (int i = 1; i < 100000; ++i)
    xml += "<bsdf type=\"a\" id=\"b" + std::to_string(i) + "\"><ref id=\"b" + std::to_string(i - 1) + "\"/></bsdf>";
  EXPECT_EQ(first_message(xml + "</scene>"), "references lead more than 200 levels deep");
}

TEST(HostileXml, CirclesThroughForwardReferencesAreFound) {
  EXPECT_EQ(first_message(R"(<scene version="3.0.0"><bsdf type="a"><ref id="y"/></bsdf>
    <bsdf type="a" id="x"><bsdf type="a" id="y"><ref id="x"/></bsdf></bsdf></scene>)"),
            "this reference leads back to itself");
}

TEST(HostileXml, IncludesThatMultiplyAreBounded) {
  TestFiles files;
  const std::string twice = repeat("<include filename=\"NEXT\"/>", 8);
  for (int i = 0; i < 12; ++i) {
    std::string text = twice;
    const std::string next = "a" + std::to_string(i + 1) + ".xml";
    for (std::size_t at; (at = text.find("NEXT")) != std::string::npos;) text.replace(at, 4, next);
    files[i == 0 ? "room.xml" : "a" + std::to_string(i) + ".xml"] = "<scene version=\"3.0.0\">" + text + "</scene>";
  }
  files["a12.xml"] = "<scene/>";
  Diagnostics diagnostics;
  EXPECT_FALSE(read_scene(files, {}, diagnostics));
  EXPECT_EQ(diagnostics.all().at(0).message, "too many includes (named at a10.xml:1:159)");
}

TEST(HostileXml, ParametersThatMultiplyAreBounded) {
  const std::string uses = repeat("<string name=\"s\" value=\"$big\"/>", 3000);
  const std::string xml =
      "<scene version=\"3.0.0\"><default name=\"big\" value=\"" + std::string(50000, 'x') + "\"/><shape type=\"a\">";
  const std::string message =
      first_message(xml + repeat("<string value=\"$big\" name=\"$big\"/>", 3000) + "</shape></scene>");
  EXPECT_NE(message, "");
}

TEST(HostileXml, ThousandsOfErrorsAreCutShortQuickly) {
#ifdef NORRSKEN_SANITIZED
  constexpr int kLess = 10;
#else
  constexpr int kLess = 1;
#endif
  // Of the processor's time: other tests run beside this one.
  const std::clock_t start = std::clock();
  Diagnostics diagnostics;
  read_scene("<scene version=\"3.0.0\">" + repeat("<bsfd/>", 300000 / kLess) + "</scene>", {}, diagnostics);
  EXPECT_LE(diagnostics.all().size(), 101u);
  std::string refs = "<scene version=\"3.0.0\">";
  for (int i = 0; i < 50000 / kLess; ++i)
    refs += "<bsdf type=\"a\" id=\"id" + std::to_string(i) + "\"/><ref id=\"missing" + std::to_string(i) + "\"/>";
  Diagnostics more;
  read_scene(refs + "</scene>", {}, more);
  EXPECT_LE(more.all().size(), 101u);
  EXPECT_GT(more.error_count(), 10);
  EXPECT_LT((std::clock() - start) / CLOCKS_PER_SEC, 20);
}

TEST(HostileXml, BytesThatAreNoTextAreNamed) {
  EXPECT_EQ(first_message("<scene version=\"3.0.0\"><string name=\"\xFF\" value=\"\"/></scene>"),
            "byte 0xff is not UTF-8: such bytes are read as windows-1252");
  EXPECT_EQ(first_message(std::string("<scene version=\"3.0.0\">\0</scene>", 32)), "the file contains a NUL byte");
  EXPECT_EQ(first_message(std::string("\xFF\xFE<\0s\0 ", 7)), "the file is UTF-16, but damaged or cut off");
}

TEST(HostileXml, EveryPrefixOfASceneIsReadOrRefused) {
  const std::string xml =
      R"(<?xml version="1.0"?><!DOCTYPE s><scene version="3.0.0"><!-- c --><default name="a" value="1"/>
    <![CDATA[x]]><sensor type="perspective" id="s"><transform name="t"><rotate x="1" angle="$a"/></transform></sensor>
    <shape type='sphere'><ref id="s"/><spectrum name="r" value="400:1, 500:2"/></shape></scene>)";
  for (std::size_t length = 0; length < xml.size(); ++length) {
    Diagnostics diagnostics;
    const auto scene = read_scene(xml.substr(0, length), {}, diagnostics);
    EXPECT_FALSE(scene.has_value()) << length;
    EXPECT_TRUE(diagnostics.has_errors()) << length;
  }
}

TEST(MitsubaXml, FilesAreReadOnceWithPreferredParametersToo) {
  class CountedFiles : public MemoryFiles {
   public:
    using MemoryFiles::MemoryFiles;
    std::optional<std::string> read(const std::string& path, std::string& error) const override {
      ++reads[path];
      return MemoryFiles::read(path, error);
    }
    mutable std::map<std::string, int> reads;
  };
  const CountedFiles files(
      {{"room.xml",
        R"(<scene version="3.0.0"><default name="spp" value="4"/><include filename="sampler.xml"/></scene>)"},
       {"sampler.xml", R"(<scene version="3.0.0"><integer name="count" value="$spp"/></scene>)"}});
  Diagnostics diagnostics;
  const auto description = read_mitsuba_xml("room.xml", files, {}, diagnostics, {{"spp", "16"}});
  ASSERT_TRUE(description.has_value()) << to_text(diagnostics);
  EXPECT_EQ(value_of<std::int64_t>(*description, "count"), 16);
  EXPECT_EQ(files.reads, (std::map<std::string, int>{{"room.xml", 1}, {"sampler.xml", 1}}));
}

}  // namespace
}  // namespace norrsken
