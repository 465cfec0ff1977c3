// Scenes that are not files on the disk: texts in memory, and what a program puts together. They render what files do.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "norrsken/version.h"
#include "tests/end_to_end/rendering.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

constexpr const char* kView = R"(<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="24"/>
  <integer name="height" value="16"/><rfilter type="box"/></film><sampler type="independent">
  <integer name="sample_count" value="4"/></sampler></sensor>)";

std::string scene_of(const std::string& elements) {
  return "<scene version=\"3.0.0\">" + (kView + elements) + "</scene>";
}

Image rendered(Result<Scene> scene) {
  for (const Diagnostic& d : scene.diagnostics().all()) ADD_FAILURE() << to_text(d);
  return scene ? render_image(*scene, {.threads = 2}) : Image{};
}

std::string first_error(const Result<Scene>& scene) {
  EXPECT_FALSE(scene);
  const auto& all = scene.diagnostics().all();
  return all.empty() ? "nothing" : all.front().message + " [" + all.front().accepted + "]";
}

constexpr const char* kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 3\n1 0 4\n-1 0 4\n0 1 4\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";

TEST(SceneInMemory, FindsItsFilesThereAndNowhereElse) {
  const TemporaryFolder folder;
  const std::string elements = R"(<include filename="parts/lamp.xml"/><shape type="ply"><string name="filename"
      value="parts/a.ply"/></shape>)";
  const std::string lamp = R"(<scene version="3.0.0"><emitter type="constant"/></scene>)";
  std::filesystem::create_directory(folder.file("parts"));
  std::ofstream(folder.file("scene.xml")) << scene_of(elements);
  std::ofstream(folder.file("parts/lamp.xml")) << lamp;
  std::ofstream(folder.file("parts/a.ply")) << kTetrahedron;
  const SceneSource memory =
      SceneSource::memory("scene.xml", scene_of(elements), {{"parts/lamp.xml", lamp}, {"./parts/a.ply", kTetrahedron}});
  EXPECT_TRUE(identical(rendered(Scene::load(memory)), rendered(Scene::load(folder.file("scene.xml")))));
  EXPECT_EQ(Scene::load(memory)->info().hash, Scene::load(folder.file("scene.xml"))->info().hash);
  EXPECT_TRUE(Scene::load(memory)->info().files.empty()) << "none is on the disk";

  // A file of the disk is not looked for.
  const std::string absolute =
      scene_of("<shape type=\"ply\"><string name=\"filename\" value=\"" + folder.file("parts/a.ply") + "\"/></shape>");
  EXPECT_NE(first_error(Scene::load(SceneSource::memory("scene.xml", absolute))).find("there is no file"),
            std::string::npos);
  EXPECT_EQ(first_error(Scene::load(SceneSource{"scen.xml", {{"scene.xml", "<scene version=\"3.0.0\"/>"}}})),
            "there is no 'scen.xml' among the scene's files, did you mean 'scene.xml'? [scene.xml]");
}

TEST(SceneInMemory, ComplainsWithPlaces) {
  const Result<Scene> scene =
      Scene::load(SceneSource::memory("a/b.xml", scene_of("\n<shape type=\"spere\"/><emitter type=\"constant\"/>")));
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.diagnostics().all().at(0).location.file, "a/b.xml");
  EXPECT_EQ(scene.diagnostics().all().at(0).location.line, 4);
  EXPECT_NE(scene.error().find("did you mean 'sphere'"), std::string::npos);
}

TEST(SceneInMemory, TheLogHearsEverything) {
  std::vector<std::string> heard;
  LoadOptions options;
  options.log = [&](const Diagnostic& d) { heard.push_back(d.message); };
  const auto scene = Scene::load(SceneSource::memory("a.xml", scene_of("<shape type=\"sphere\"/>")), options);
  ASSERT_TRUE(scene);
  EXPECT_EQ(heard, std::vector<std::string>{"the scene has no emitter: its image is black"});
  EXPECT_EQ(scene.diagnostics().all().size(), 1u);
}

/// The scene of kView around `elements`, put together.
Description description_of(const std::vector<Node>& elements) {
  Node film("film", "hdrfilm"), sampler("sampler", "independent"), sensor("sensor", "perspective");
  film.set("width", 24).set("height", 16).add(Node("rfilter", "box"));
  sampler.set("sample_count", 4);
  sensor.add(film).add(sampler);
  auto root = std::make_shared<Node>("scene");
  root->add(sensor);
  for (const Node& element : elements) root->add(element);
  Description description;
  description.scene = root;
  return description;
}

TEST(BuiltScene, RendersWhatItsFileRenders) {
  Node sphere("shape", "sphere"), lamp("emitter", "constant"), bsdf("bsdf", "diffuse");
  bsdf.set("reflectance", Property::Rgb{{0.2, 0.6, 0.4}});
  sphere.set("center", Property::Vector{{0, 0, 5}}).set("radius", 1.5f).set("flip_normals", false).add(bsdf);
  lamp.set("radiance", Property::Spectrum{{{400, 1.0}, {700, 2.0}}});
  Node integrator("integrator", "path");
  integrator.set("max_depth", 3);
  const std::string xml = R"(<integrator type="path"><integer name="max_depth" value="3"/></integrator>
    <shape type="sphere"><point name="center" value="0 0 5"/><float name="radius" value="1.5"/>
    <boolean name="flip_normals" value="false"/><bsdf type="diffuse"><rgb name="reflectance" value="0.2 0.6 0.4"/></bsdf>
    </shape><emitter type="constant"><spectrum name="radiance" value="400:1 700:2"/></emitter>)";
  const auto built = Scene::build(description_of({integrator, sphere, lamp}));
  EXPECT_TRUE(identical(rendered(built), rendered(Scene::load(SceneSource::memory("scene.xml", scene_of(xml))))));
  // Another description is another scene, for checkpoints and image files.
  sphere.set("radius", 1.25);
  const auto other = Scene::build(description_of({integrator, sphere, lamp}));
  EXPECT_NE(built->info().hash, other->info().hash);
  EXPECT_EQ(built->info().hash.size(), 32u);
}

Mesh tetrahedron() {
  Mesh mesh;
  mesh.positions = {0, 0, 3, 1, 0, 4, -1, 0, 4, 0, 1, 4};
  mesh.triangles = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  return mesh;
}

TEST(BuiltScene, TakesMeshesAndArraysAsFilesDo) {
  const std::map<std::string, std::string> files{{"a.ply", kTetrahedron}};
  const std::string xml =
      scene_of(R"(<shape type="ply"><string name="filename" value="a.ply"/></shape><emitter type="constant"/>)");
  const Image from_file = rendered(Scene::load(SceneSource::memory("scene.xml", xml, files)));
  const Node lamp("emitter", "constant");
  Node whole("shape", "mesh"), arrays("shape", "mesh"), named("shape", "ply");
  whole.set("mesh", tetrahedron());
  arrays.set("positions", tetrahedron().positions).set("triangles", tetrahedron().triangles);
  named.set("filename", "a.ply");
  EXPECT_TRUE(identical(rendered(Scene::build(description_of({whole, lamp}))), from_file));
  EXPECT_TRUE(identical(rendered(Scene::build(description_of({arrays, lamp}))), from_file));
  EXPECT_TRUE(identical(rendered(Scene::build(description_of({named, lamp}), {}, files)), from_file));
  // Files of scenes may say it, too.
  const std::string text = scene_of(R"(<shape type="mesh"><string name="positions" value="0 0 3, 1 0 4, -1 0 4, 0 1 4"/>
      <string name="triangles" value="0 1 2  0 3 1  0 2 3  1 3 2"/></shape><emitter type="constant"/>)");
  EXPECT_TRUE(identical(rendered(Scene::load(SceneSource::memory("scene.xml", text))), from_file));
}

TEST(BuiltScene, LooksAtNothingThatNoTriangleUses) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Node lamp("emitter", "constant");
  Mesh clean = tetrahedron(), odd = clean, empty;
  clean.positions.insert(clean.positions.end(), {0, 0, 0});
  odd.positions.insert(odd.positions.end(), {nan, 1e30f, 0});
  const auto rendered_mesh = [&](const Mesh& mesh) {
    return rendered(Scene::build(description_of({Node("shape", "mesh").set("mesh", mesh), lamp})));
  };
  EXPECT_TRUE(identical(rendered_mesh(odd), rendered_mesh(clean)));
  const auto built = Scene::build(description_of({Node("shape", "mesh").set("mesh", empty), lamp}));
  ASSERT_TRUE(built);
  ASSERT_EQ(built.diagnostics().all().size(), 1u);
  EXPECT_EQ(built.diagnostics().all()[0].message, "the mesh has no triangles, nothing of it is drawn");
}

/// A colour for each vertex of a mesh that is as bright as it says, all around.
TEST(BuiltScene, MeshesHaveAttributesNormalsAndTexcoords) {
  Mesh square;
  square.positions = {-9, -9, 3, 9, -9, 3, 9, 9, 3, -9, 9, 3};
  square.triangles = {0, 2, 1, 0, 3, 2};
  square.normals = {0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1};
  square.texcoords = {0, 0, 1, 0, 1, 1, 0, 1};
  square.attributes = {{"vertex_glow", 3, {0.5f, 0.25f, 2, 0.5f, 0.25f, 2, 0.5f, 0.25f, 2, 0.5f, 0.25f, 2}}};
  Node glow("texture", "mesh_attribute"), emitter("emitter", "area"), shape("shape", "mesh");
  glow.set("name", "vertex_glow");
  emitter.add(glow, "radiance");
  shape.set("mesh", square).add(emitter);
  const Image image = rendered(Scene::build(description_of({shape})));
  EXPECT_EQ(image.find("R")->values.at(100), 0.5f);
  EXPECT_EQ(image.find("G")->values.at(100), 0.25f);
  EXPECT_EQ(image.find("B")->values.at(100), 2.0f);
}

Image picture(int width, int height, float red, float green, float blue) {
  Image image;
  image.width = width, image.height = height;
  for (const auto& [name, value] : {std::pair{"R", red}, {"G", green}, {"B", blue}})
    std::ranges::fill(image.channel(name).values, value);
  return image;
}

TEST(BuiltScene, TexturesAndEnvironmentsTakeImages) {
  Node environment("emitter", "envmap");
  environment.set("image", picture(4, 3, 0.5f, 1, 1.5f));
  const Node sphere = Node("shape", "sphere").set("center", Property::Vector{{0, 0, -50}});
  const Image around = rendered(Scene::build(description_of({environment, sphere})));
  EXPECT_FLOAT_EQ(around.find("R")->values.at(40), 0.5f);
  EXPECT_FLOAT_EQ(around.find("B")->values.at(40), 1.5f);

  Node bitmap("texture", "bitmap"), emitter("emitter", "area"), wall("shape", "rectangle");
  Image grey;
  grey.width = grey.height = 2;
  std::ranges::fill(grey.channel("Y").values, 3.0f);
  bitmap.set("image", grey);
  emitter.add(bitmap, "radiance");
  Property::Transform placed;
  placed.rows = {{{-9, 0, 0, 0}, {0, 9, 0, 0}, {0, 0, -1, 4}, {0, 0, 0, 1}}};
  wall.set("to_world", placed).add(emitter);
  const Image lit = rendered(Scene::build(description_of({wall})));
  EXPECT_FLOAT_EQ(lit.find("G")->values.at(200), 3);
}

struct Wrong {
  const char* name;
  std::function<Description()> make;
  const char* message;
};

TEST(BuiltScene, WhatIsWrongIsSaid) {
  const Node lamp("emitter", "constant");
  const auto with = [&](Node node) { return description_of({std::move(node), lamp}); };
  const auto mesh_with = [&](const std::function<void(Mesh&)>& change) {
    Mesh mesh = tetrahedron();
    change(mesh);
    return with(Node("shape", "mesh").set("mesh", std::move(mesh)));
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto error = [](const Description& description) { return first_error(Scene::build(description)); };
  EXPECT_EQ(error({}), "the description has no scene [a node of kind 'scene']");
  EXPECT_EQ(error(mesh_with([](Mesh& m) { m.triangles.back() = 4; })),
            "a triangle of the mesh has vertex 4 of 4 [vertices counted from 0]");
  EXPECT_EQ(error(mesh_with([](Mesh& m) { m.triangles.pop_back(); })),
            "11 corners of the mesh's triangles [a multiple of 3]");
  EXPECT_EQ(error(mesh_with([&](Mesh& m) { m.positions[3] = nan; })),
            "some coordinates of the mesh are not finite, or too large [-1e+12 to 1e+12]");
  EXPECT_EQ(error(mesh_with([](Mesh& m) {
              m.normals = {0, 0, 1};
            })),
            "the mesh has 3 components of normals [12 of them]");
  EXPECT_EQ(error(mesh_with([](Mesh& m) {
              m.attributes = {{"glow", 1, {1, 2, 3, 4}}};
            })),
            "attribute 'glow' of the mesh [a name that begins with vertex_ or face_]");
  EXPECT_EQ(error(mesh_with([](Mesh& m) {
              m.attributes = {{"vertex_glow", 1, {1, 2, 3, 4}}, {"vertex_glow", 1, {1, 2, 3, 4}}};
            })),
            "the mesh has two attributes 'vertex_glow' [one of each name]");
  Node twice("shape", "sphere");
  twice.properties = {{"radius", 1.0}, {"radius", 2.0}};
  EXPECT_EQ(error(with(twice)), "'radius' is given twice to shape 'sphere' [one value of each name]");
  EXPECT_EQ(error(with(Node("shape", "mesh").set("positions", FloatArray{0, 0, 0}))),
            "shape 'mesh' needs a parameter 'triangles' [<string name=\"triangles\" value=\"0 1 2\"/>]");
  EXPECT_EQ(error(with(Node("shape", "sphere").set("radius", std::numeric_limits<double>::quiet_NaN()))),
            "'radius' is nan [a number of at least 0]");
  EXPECT_EQ(error(with(Node("shape", "sphere").set("radius", Mesh{}))), "'radius' is a mesh [float]");
  EXPECT_EQ(error(with(Node("emitter", "envmap").set("image", Image{}))),
            "'image' has no colours [channels R, G and B, or Y]");
  EXPECT_EQ(
      error(with(Node("bsdf", "diffuse").set("reflectance", Property::Spectrum{{{500, 1}, {400, 1}}}))),
      "spectrum 'reflectance' of bsdf 'diffuse' is malformed [one value, or finite values at ascending wavelengths "
      "above 0 nm]");
  const auto loop = std::make_shared<Node>("bsdf", "twosided");
  loop->add(std::shared_ptr<const Node>(loop));
  Description endless = description_of({lamp});
  Node root = *endless.scene;
  root.add(std::shared_ptr<const Node>(loop));
  endless.scene = std::make_shared<const Node>(root);
  EXPECT_EQ(error(endless), "bsdf 'twosided' stands inside of itself [a tree of nodes]");
  loop->children.clear();
  Node deep("bsdf", "twosided");
  for (int i = 0; i < 120; ++i) deep = Node("bsdf", "twosided").add(deep);
  EXPECT_EQ(error(with(deep)), "nodes are nested more than 100 deep [up to 100]");
  Description childless = description_of({lamp});
  Node null_child = *childless.scene;
  null_child.children.push_back({});
  childless.scene = std::make_shared<const Node>(null_child);
  EXPECT_EQ(error(childless), "a child of scene is null [a node]");
}

TEST(SceneFormats, AreToldByName) {
  const auto formats = scene_formats();
  ASSERT_FALSE(formats.empty());
  EXPECT_EQ(formats[0].name, "Mitsuba XML");
  EXPECT_EQ(formats[0].suffixes, std::vector<std::string>{".xml"});
}

TEST(Version, IsThatOfImages) {
  const Image image = rendered(
      Scene::load(SceneSource::memory("a.xml", scene_of("<shape type=\"sphere\"/><emitter type=\"constant\"/>"))));
  EXPECT_EQ(image.metadata.at("Software"), std::string("norrsken ") + version());
}

}  // namespace
}  // namespace norrsken::end_to_end
