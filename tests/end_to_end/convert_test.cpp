// norrsken convert: what it writes renders as what it read.
#include "norrsken/convert.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/end_to_end/rendering.h"
#include "tests/temporary_folder.h"

namespace norrsken::end_to_end {
namespace {

LoadOptions small() {
  LoadOptions options;
  options.sampler = "independent";
  options.width = 24, options.height = 18;
  options.samples_per_pixel = 4;
  return options;
}

std::string contents_of(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Converts the scene, renders both, and returns the XML.
std::string convert_and_compare(const SceneSource& source) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.xml");
  const auto written = convert_scene(source, path);
  EXPECT_TRUE(written) << written.error();
  if (!written) return {};
  for (const std::string& file : *written) EXPECT_TRUE(std::filesystem::exists(file)) << file;
  const auto before = Scene::load(source, small());
  const auto after = Scene::load(path, small());
  EXPECT_TRUE(before) << before.error();
  EXPECT_TRUE(after) << after.error();
  if (!before || !after) return {};
  EXPECT_TRUE(identical(render_image(*before, {}), render_image(*after, {})));
  return contents_of(path);
}

TEST(Convert, AMeshIsTheSamePicture) {
  const std::string obj =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\nf 1/1 3/2 "
      "4/3\n"
      "usemtl lamp\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\n";
  const std::string xml = convert_and_compare(
      SceneSource::memory("a.obj", obj,
                          {{"a.mtl", "newmtl red\nKd 1 0.1 0\nmap_Kd a.ppm\nd 0.5\nnewmtl lamp\nKd 0.5\nKe 3 3 3\n"},
                           {"a.ppm", "P3 2 2 255 255 0 0 0 255 0 0 0 255 255 255 255\n"}}));
  EXPECT_NE(xml.find("out_files/a.ppm"), std::string::npos) << xml;
  EXPECT_NE(xml.find("out_files/image_0000.exr"), std::string::npos) << xml;
}

TEST(Convert, SharedPartsAndInstancesAreTheSamePicture) {
  const std::string xml = convert_and_compare(SceneSource::memory("a.xml", R"(<scene version="3.0.0">
    <integrator type="path"><integer name="bounces" value="4"/></integrator>
    <bsdf type="twosided" id="grey"><bsdf type="diffuse"><rgb name="reflectance" value="0.2, 0.5, 0.8"/></bsdf></bsdf>
    <shape type="shapegroup" id="group"><shape type="cube"><ref id="grey"/></shape></shape>
    <shape type="instance"><ref id="group"/><transform name="to_world"><rotate y="1" angle="30"/><translate x="-2"/></transform></shape>
    <shape type="instance"><ref id="group"/><transform name="to_world"><translate x="2"/></transform></shape>
    <shape type="sphere"><ref id="grey"/></shape>
    <emitter type="constant"/><emitter type="directional"><vector name="direction" x="1" y="-1" z="0.5"/></emitter>
    <sensor type="perspective"><float name="fov" value="40"/>
      <transform name="to_world"><lookat origin="1, 3, -9" target="0, 0, 0" up="0, 1, 0"/></transform></sensor></scene>)"));
  EXPECT_NE(xml.find("<ref id=\"grey\"/>"), std::string::npos) << xml;
  EXPECT_NE(xml.find("<integer name=\"max_depth\" value=\"5\"/>"), std::string::npos) << xml;
}

TEST(Convert, APbrtSceneIsTheSamePicture) {
  convert_and_compare(SceneSource::memory(
      "a.pbrt",
      "LookAt 0 1 -5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\nSampler \"independent\"\nWorldBegin\n"
      "LightSource \"infinite\" \"rgb L\" [ .3 .4 .5 ]\nMaterial \"diffuse\" \"rgb reflectance\" [ .8 .2 .1 ]\n"
      "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 0 1 -1 0 0 1 0 ] \"integer indices\" [ 0 1 2 ]\n"
      "Material \"conductor\" \"float roughness\" .1\nTranslate 1 0 1 Scale 1 .5 1\nShape \"sphere\"\n"));
}

TEST(Convert, SaysWhatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto source = SceneSource::memory("a.xml", "<scene version=\"3.0.0\"/>");
  EXPECT_EQ(convert_scene(source, folder.file("a.json")).error().find("cannot write a scene to"), 0u);
  EXPECT_FALSE(convert_scene(source, folder.file("no/such/folder/a.xml")));
  EXPECT_FALSE(convert_scene(SceneSource::memory("a.xml", "<scene"), folder.file("b.xml")));
}

}  // namespace
}  // namespace norrsken::end_to_end
