#include "norrsken/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "compile/compile.h"
#include "render/scene_state.h"
#include "scene/file_system.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene load_room(const LoadOptions& options = {}) {
  Diagnostics diagnostics;
  auto scene = told(Scene::load("hexagon_room", options), diagnostics);
  for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << to_text(d);
  return scene.value();
}

std::vector<float> reflectance_front(const SceneTables& t, std::size_t primitive) {
  const auto first = t.parameters.begin() + (t.surfaces[primitive].material_front & kMaterialOffsetMask);
  return {first, first + 3};
}

/// The middle of a triangle.
std::array<double, 3> centroid(const SceneTables& t, std::size_t triangle) {
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[axis] += t.positions[3 * t.triangle_vertices[3 * triangle + k] + axis] / 3.0;
    }
  }
  return sum;
}

double side_of(const SurfaceRecord& plane, double x, double y, double z) {
  return plane.geometry[0] * x + plane.geometry[1] * y + plane.geometry[2] * z - plane.geometry[3];
}

TEST(HexagonRoom, HasTheReportsGeometry) {
  const Scene scene = load_room();
  const SceneTables& t = scene.tables().tables;
  EXPECT_EQ(t.triangle_count(), 30u);
  EXPECT_EQ(t.sphere_count(), 1u);
  EXPECT_THAT(t.surfaces[30].geometry, ElementsAre(7, -2.5f, -2, 1.5f));
  EXPECT_EQ(material_kind(t.surfaces[30].material_front), BsdfKind::conductor);
  EXPECT_THAT(t.normals, IsEmpty());
  EXPECT_THAT(scene.info().bounds_min, ElementsAre(-3, -6, -5));
  EXPECT_THAT(scene.info().bounds_max, ElementsAre(13, 6, 5));
}

TEST(HexagonRoom, WallsLookInwardsAndTheTetrahedronOutwards) {
  const Scene scene = load_room();
  const SceneTables& t = scene.tables().tables;
  int room = 0, tetrahedron = 0;
  for (std::uint32_t i = 0; i < t.triangle_count(); ++i) {
    const SurfaceRecord& surface = t.surfaces[i];
    if (t.light_of(i) != kNone) continue;
    // In the order of the file: floor, ceiling and six walls, then the tetrahedron.
    if (surface.shape < 8) {
      ++room;
      EXPECT_GT(side_of(surface, 5, 0, 0), 0) << i;
      EXPECT_GT(side_of(surface, -1, 0, 0), 0) << i;
    } else {
      ++tetrahedron;
      EXPECT_LT(side_of(surface, 8, 9.5 / 3, -4.25), 0) << i;
    }
  }
  EXPECT_EQ(room, 24);
  EXPECT_EQ(tetrahedron, 4);
}

TEST(HexagonRoom, IsClosed) {
  // Every edge of the room's 24 triangles is run through once each way.
  const Scene scene = load_room();
  const SceneTables& t = scene.tables().tables;
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
  for (std::size_t i = 0; i < 24; ++i) {
    std::array<std::array<float, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      std::copy_n(&t.positions[3 * t.triangle_vertices[3 * i + k]], 3, corners[k].begin());
    }
    for (std::size_t k = 0; k < 3; ++k) ++edges[{corners[k], corners[(k + 1) % 3]}];
  }
  EXPECT_EQ(edges.size(), 72u);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

TEST(HexagonRoom, HasTheReportsColours) {
  const Scene scene = load_room();
  const SceneTables& t = scene.tables().tables;
  const std::vector<float> white{0.8f, 0.8f, 0.8f}, red{0.8f, 0.2f, 0.2f}, green{0.2f, 0.8f, 0.2f},
      blue{0.2f, 0.2f, 0.8f};
  const std::vector<float> walls[] = {red, green, blue, blue, green, red};
  // Middles of the walls, in the order of the corners that they start at.
  const double middles[][2] = {{-1.5, 3}, {5, 6}, {11.5, 3}, {11.5, -3}, {5, -6}, {-1.5, -3}};
  int seen[6] = {};
  for (std::uint32_t i = 0; i < 30; ++i) {
    const auto [x, y, z] = centroid(t, i);
    if (t.light_of(i) != kNone) {
      EXPECT_EQ(material_kind(t.surfaces[i].material_front), BsdfKind::absorb);
      continue;
    }
    ASSERT_EQ(material_kind(t.surfaces[i].material_front), BsdfKind::diffuse);
    const bool floor_or_ceiling = std::abs(z) == 5.0 && t.surfaces[i].geometry[2] * z < 0;
    if (floor_or_ceiling) {
      EXPECT_EQ(reflectance_front(t, i), white) << i;
      continue;
    }
    int wall = -1;
    for (int w = 0; w < 6; ++w) {
      if (std::abs(t.surfaces[i].geometry[2]) < 1e-6f &&
          std::abs(side_of(t.surfaces[i], middles[w][0], middles[w][1], 0)) < 1e-5) {
        wall = w;
      }
    }
    EXPECT_EQ(reflectance_front(t, i), wall < 0 ? green : walls[wall]) << i;  // otherwise the tetrahedron
    if (wall >= 0) ++seen[wall];
  }
  EXPECT_THAT(seen, ElementsAre(2, 2, 2, 2, 2, 2));
}

TEST(HexagonRoom, HasOneParallelogramLightOrAPointOfTheSameFlux) {
  const Scene area = load_room();
  ASSERT_EQ(area.tables().tables.lights.size(), 1u);
  const LightRecord& panel = area.tables().tables.lights[0];
  EXPECT_EQ(panel.kind, LightKind::parallelogram);
  EXPECT_FLOAT_EQ(panel.area, 4);
  EXPECT_THAT(panel.normal, ElementsAre(0, 0, -1));
  EXPECT_THAT(panel.emission, ElementsAre(10, 10, 10));
  EXPECT_EQ(panel.origin[2], 4.9f);

  const Scene point =
      load_room({.parameters = {{"light", "point"}}, .integrator = {}, .sampler = {}, .width = {}, .height = {}});
  EXPECT_EQ(point.tables().tables.triangle_count(), 28u);
  ASSERT_EQ(point.tables().tables.lights.size(), 1u);
  EXPECT_EQ(point.tables().tables.lights[0].kind, LightKind::point);
  EXPECT_THAT(point.tables().tables.lights[0].origin, ElementsAre(4.9f, 0, 4.9f));
  EXPECT_THAT(point.tables().tables.lights[0].emission, ElementsAre(10, 10, 10));
}

TEST(HexagonRoom, IsSeenAsInTheReport) {
  const Scene scene = load_room();
  const CameraRecord& camera = scene.tables().tables.camera;
  EXPECT_THAT(camera.origin, ElementsAre(-1, 0, 0));
  // The image plane's corners: +y at the left, +z at the top.
  const auto at = [&](int axis, float px, float py) {
    return camera.origin[axis] + camera.base[axis] + px * camera.du[axis] + py * camera.dv[axis];
  };
  const float corners[][2] = {{0, 0}, {800, 0}, {0, 800}, {800, 800}};
  const float expected[][2] = {{1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(at(0, corners[i][0], corners[i][1]), 0, 1e-6);
    EXPECT_NEAR(at(1, corners[i][0], corners[i][1]), expected[i][0], 1e-6);
    EXPECT_NEAR(at(2, corners[i][0], corners[i][1]), expected[i][1], 1e-6);
  }
}

TEST(HexagonRoom, TakesItsParameters) {
  const SceneInfo standard = load_room().info();
  EXPECT_EQ(standard.width, 800);
  EXPECT_EQ(standard.height, 800);
  EXPECT_EQ(standard.samples_per_pixel, 64);
  EXPECT_EQ(standard.emitter_samples, 64);
  EXPECT_EQ(standard.max_depth, 4);
  EXPECT_EQ(standard.integrator, "path");
  EXPECT_EQ(standard.sampler, "sobol");

  LoadOptions options;
  options.parameters = {{"spp", "5"}, {"bounces", "2"}, {"resolution", "200"}, {"integrator", "whitted"}};
  const SceneInfo changed = load_room(options).info();
  EXPECT_EQ(changed.width, 200);
  EXPECT_EQ(changed.samples_per_pixel, 5);
  EXPECT_EQ(changed.emitter_samples, 5);
  EXPECT_EQ(changed.max_depth, 3);
  EXPECT_EQ(changed.integrator, "whitted");

  options.parameters = {{"spp", "5"}, {"shadow_rays", "20"}};
  options.integrator = "direct";
  options.sampler = "independent";
  options.width = 64;
  options.height = 32;
  const SceneInfo overridden = load_room(options).info();
  EXPECT_EQ(overridden.emitter_samples, 20);
  EXPECT_EQ(overridden.max_depth, 2);
  EXPECT_EQ(overridden.sampler, "independent");
  EXPECT_EQ(overridden.width, 64);
  EXPECT_EQ(overridden.height, 32);
}

TEST(HexagonRoom, RefusesParametersThatItDoesNotHave) {
  Diagnostics diagnostics;
  LoadOptions options;
  options.parameters = {{"bounce", "2"}};
  EXPECT_FALSE(told(Scene::load("hexagon_room", options), diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 1);
  EXPECT_THAT(to_text(diagnostics.all()[0]), HasSubstr("bounces"));
}

TEST(SceneLoad, NamesTheBuiltInScenesWhenThereIsNoSuchFile) {
  Diagnostics diagnostics;
  EXPECT_FALSE(told(Scene::load("hexagon_rom", {}), diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(to_text(diagnostics.all()[0]),
            "error: there is no scene file or built-in scene 'hexagon_rom', did you mean 'hexagon_room'?\n"
            "accepted: the path of a scene file, or one of gallery_cameras, gallery_lights, gallery_materials, "
            "hexagon_room");
}

TEST(SceneLoad, ReadsAFileFromDisk) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("scene.xml", R"(<scene version="3.0.0"><sensor type="perspective"><film type="hdrfilm">
    <rfilter type="box"/></film></sensor><shape type="sphere"/><emitter type="point"/></scene>)");
  Diagnostics diagnostics;
  const auto scene = told(Scene::load(path, {}), diagnostics);
  ASSERT_TRUE(scene);
  EXPECT_THAT(diagnostics.all(), IsEmpty());
  EXPECT_EQ(scene->info().spheres, 1u);
}

TEST(HexagonRoom, TakesItsSamplesPerPixelFromTheOptions) {
  LoadOptions options;
  options.samples_per_pixel = 5;
  const SceneInfo followed = load_room(options).info();
  EXPECT_EQ(followed.samples_per_pixel, 5);
  EXPECT_EQ(followed.emitter_samples, 5);

  options.parameters = {{"shadow_rays", "1"}};
  EXPECT_EQ(load_room(options).info().samples_per_pixel, 5);
  EXPECT_EQ(load_room(options).info().emitter_samples, 1);

  options.parameters = {{"spp", "7"}};
  EXPECT_EQ(load_room(options).info().samples_per_pixel, 5);
  EXPECT_EQ(load_room(options).info().emitter_samples, 7);
}

std::string load_messages(const std::string& path_or_name, const LoadOptions& options) {
  Diagnostics diagnostics;
  told(Scene::load(path_or_name, options), diagnostics);
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += to_text(d) + "\n";
  return text;
}

TEST(SceneLoad, RefusesToTakeNoSamples) {
  for (const int count : {0, -3}) {
    LoadOptions options;
    options.samples_per_pixel = count;
    EXPECT_EQ(load_messages("hexagon_room", options),
              "error: " + std::to_string(count) + " samples per pixel\naccepted: an integer from 1 to 2147483647\n");
  }
}

/// A scene on disk for as long as the object lives.
class SceneOnDisk {
 public:
  explicit SceneOnDisk(const std::string& elements)
      : path_(folder_.write("scene.xml", "<scene version=\"3.0.0\">\n" + elements + "\n</scene>\n")) {}
  const std::string& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::string path_;
};

TEST(SceneLoad, SamplesPerPixelDoNotNeedAParameterThatIsUsed) {
  const std::string rest = R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film></sensor>
    <shape type="sphere"/><emitter type="point"/>)";
  LoadOptions options;
  options.samples_per_pixel = 9;
  for (const std::string unused : {"", R"(<default name="spp" value="3"/>)"}) {
    const SceneOnDisk file(unused + rest);
    Diagnostics diagnostics;
    const auto scene = told(Scene::load(file.path(), options), diagnostics);
    EXPECT_THAT(diagnostics.all(), IsEmpty());
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->info().samples_per_pixel, 9);
  }
}

TEST(SceneLoad, TellsWhatIsWrongInTheOrderOfTheFile) {
  const SceneOnDisk file(R"(<shape type="sphere"><float name="radius" value="-1"/></shape>
<emitter type="pont"/>
<integrator type="pth"/>
<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film></sensor>)");
  Diagnostics diagnostics;
  LoadOptions options;
  options.samples_per_pixel = 0;
  EXPECT_FALSE(told(Scene::load(file.path(), options), diagnostics));
  std::vector<int> lines;
  for (const Diagnostic& d : diagnostics.all()) lines.push_back(d.location.line);
  EXPECT_THAT(lines, ElementsAre(2, 3, 4, 0));
}

TEST(SceneLoad, AFolderDoesNotHideABuiltInSceneButAFileDoes) {
  namespace fs = std::filesystem;
  const fs::path before = fs::current_path();
  const TemporaryFolder folder;
  fs::create_directories(folder / "hexagon_room");
  fs::create_directories(folder / "other");
  fs::current_path(folder.path());
  EXPECT_EQ(load_messages("hexagon_room", {}), "");
  EXPECT_EQ(load_messages("other", {}), "error: cannot read the scene 'other': is a folder\naccepted: an XML file\n");
  fs::remove_all("hexagon_room");
  std::ofstream("hexagon_room") << "not XML";
  EXPECT_THAT(load_messages("hexagon_room", {}), HasSubstr("error"));
  fs::current_path(before);
}

TEST(SceneLoad, AnEmptyPluginNameIsNotNoName) {
  LoadOptions options;
  options.integrator = options.sampler = "";
  EXPECT_EQ(
      load_messages("hexagon_room", options),
      "error: unknown integrator ''\naccepted: aov, depth, direct, moment, path, ptracer, volpath, volpathmis, "
      "whitted\n"
      "error: unknown sampler ''\naccepted: independent, ldsampler, multijitter, orthogonal, sobol, stratified\n");
}

TEST(SceneLoad, RefusesFolders) {
  Diagnostics diagnostics;
  EXPECT_FALSE(told(Scene::load(TemporaryFolder().string(), {}), diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(BuiltinScenes, EveryOneLoadsAndHasADescription) {
  const auto scenes = builtin_scenes();
  ASSERT_FALSE(scenes.empty());
  for (const BuiltinScene& scene : scenes) {
    EXPECT_THAT(scene.description, Not(IsEmpty())) << scene.name;
    EXPECT_THAT(scene.description, Not(HasSubstr("\n"))) << scene.name;
    Diagnostics diagnostics;
    EXPECT_TRUE(told(Scene::load(scene.name, {}), diagnostics)) << scene.name;
    for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << to_text(d);
  }
}

TEST(BuiltinFiles, AreThoseOfTheFolder) {
  for (const auto& [path, contents] : builtin_files()) {
    std::ifstream file(std::string(NORRSKEN_SCENES) + "/" + std::string(path), std::ios::binary);
    ASSERT_TRUE(file) << path;
    const std::string on_disk(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(contents, on_disk) << path;
  }
}

TEST(SceneState, LightsAreChosenByPlaceForPathsFromTheCameraAlone) {
  std::string xml = R"(<scene version="3.0.0"><sensor type="perspective"/><shape type="sphere"/>)";
  for (int i = 0; i < 40; ++i) xml += R"(<emitter type="point"/>)";
  const auto scene = Scene::load(SceneSource::memory("a.xml", xml + "</scene>"));
  ASSERT_TRUE(scene);
  ViewOptions from_lights;
  from_lights.integrator = "ptracer";
  const auto other = scene->with(from_lights);
  ASSERT_TRUE(other);
  EXPECT_NE(scene->state().view(scene->frame(), {}).light_nodes, nullptr);
  EXPECT_EQ(scene->state().view(other->frame(), {}).light_nodes, nullptr);
}

}  // namespace
}  // namespace norrsken
