// The picture of flat meshes must not depend on the accelerator: whatever differs between coplanar triangles is seen of
// each, although `planes` makes one polygon of those that differ in nothing.
#include <gmock/gmock.h>

#include <cmath>

#include "accel/polygons.h"
#include "compile/compile.h"
#include "norrsken/image.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/scene_folder.h"

namespace norrsken::end_to_end {
namespace {

constexpr int kSize = 24;

/// Two triangles of a square: `faces` is the index lists with what belongs to each.
std::string obj(const std::string& texcoords, const std::string& faces) {
  return "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n" + texcoords + faces;
}
const std::string kSquareUv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const std::string kOneMap = obj(kSquareUv, "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
const std::string kIslands = obj(kSquareUv, "f 1/1 2/2 3/3\nf 1/3 3/1 4/2\n");
const std::string kTurned = obj(kSquareUv, "f 1/1 2/2 3/3\nf 1/2 3/4 4/1\n");
const std::string kHalfMapped = obj(kSquareUv, "f 1/1 2/2 3/3\nf 1 3 4\n");
const std::string kNotMapped = obj("", "f 1 2 3\nf 1 3 4\n");
const std::string kTrapezoid =
    "v -1 -1 0\nv 1 -1 0\nv 0.3 1 0\nv -0.3 1 0\n" + kSquareUv + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

std::string ply(const std::string& vertex_properties, const std::string& vertices, const std::string& face_properties,
                const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
         vertex_properties + "element face 2\nproperty list uchar int vertex_indices\n" + face_properties +
         "end_header\n" + vertices + faces;
}
const std::string kFaceColours =
    ply("", "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n", "property float red\nproperty float green\nproperty float blue\n",
        "3 0 1 2 0.9 0.1 0.1\n3 0 2 3 0.1 0.9 0.1\n");
const std::string kVertexColours =
    ply("property float red\nproperty float green\nproperty float blue\n",
        "-1 -1 0 0.9 0.1 0.1\n1 -1 0 0.1 0.9 0.1\n1 1 0 0.1 0.1 0.9\n-1 1 0 0.9 0.9 0.9\n", "", "3 0 1 2\n3 0 2 3\n");

const std::string kChecks =
    R"(<texture type="checkerboard" name="NAME"><transform name="to_uv"><scale x="3" y="5"/></transform></texture>)";
std::string checks(const std::string& name) {
  std::string texture = kChecks;
  return texture.replace(texture.find("NAME"), 4, name);
}
std::string attribute(const std::string& name) {
  return R"(<bsdf type="diffuse"><texture type="mesh_attribute" name="reflectance">)" + text("name", name) +
         "</texture></bsdf>";
}
const std::string kChecked = R"(<bsdf type="diffuse">)" + checks("reflectance") + "</bsdf>";
const std::string kGrey = diffuse("0.5");

struct Case {
  const char* name;
  std::string mesh;
  std::string inside;        ///< of the shape: a BSDF, an emitter
  std::size_t polygons = 2;  ///< that `planes` may make of it
  const char* file = "m.obj";
  const char* aovs = "";
};

const Case kCases[] = {
    {"one_map", kOneMap, kChecked, 1},
    {"islands", kIslands, kChecked},
    {"turned", kTurned, kChecked},
    {"trapezoid", kTrapezoid, kChecked},
    {"half_mapped", kHalfMapped, kChecked},
    {"not_mapped", kNotMapped, kChecked},
    {"islands_that_nothing_looks_at", kIslands, kGrey, 1},
    {"not_mapped_and_plain", kNotMapped, kGrey, 1},
    {"face_colours", kFaceColours, attribute("face_color"), 2, "m.ply"},
    {"vertex_colours", kVertexColours, attribute("vertex_color"), 2, "m.ply"},
    {"colours_that_nothing_looks_at", kFaceColours, kGrey, 1, "m.ply"},
    {"bitmap", kIslands,
     R"(<bsdf type="diffuse"><texture type="bitmap" name="reflectance">)" + text("filename", "ramp.exr") +
         "</texture></bsdf>"},
    {"deep_inside", kIslands,
     R"(<bsdf type="twosided"><bsdf type="blendbsdf"><float name="weight" value="0.5"/>)" + kGrey +
         R"(<bsdf type="mask">)" + checks("opacity") + kGrey + "</bsdf></bsdf></bsdf>"},
    {"normal_map", kTurned,
     R"(<bsdf type="normalmap"><rgb name="normalmap" value="0.8, 0.5, 0.9"/>)" + kGrey + "</bsdf>"},
    {"bump_map", kTurned,
     R"(<bsdf type="bumpmap"><texture type="bitmap" name="any">)" + text("filename", "ramp.exr") + "</texture>" +
         kGrey + "</bsdf>"},
    {"along_u", kTurned,
     R"(<bsdf type="roughconductor"><float name="alpha_u" value="0.4"/><float name="alpha_v" value="0.05"/></bsdf>)"},
    {"light", kIslands, R"(<emitter type="area">)" + checks("radiance") + "</emitter>"},
    {"uv_layer", kIslands, kGrey, 2, "m.obj", "n:uv"},
    {"tangent_layer", kTurned, kGrey, 2, "m.obj", "n:dp_du"},
    {"triangle_layer", kOneMap, kGrey, 2, "m.obj", "n:prim_index"},
    {"normal_layer", kNotMapped, kGrey, 1, "m.obj", "n:sh_normal"},
};

class Accelerators : public SceneFolder, public ::testing::WithParamInterface<Case> {
 protected:
  void write_scene() const {
    const Case& c = GetParam();
    Image ramp;
    ramp.width = ramp.height = 8;
    for (const char* name : {"R", "G", "B"}) {
      auto& values = ramp.channel(name).values;
      for (std::size_t i = 0; i < 64; ++i) values[i] = static_cast<float>(i % 8 + i / 8) / 16.0f;
    }
    ASSERT_TRUE(write_image(path("ramp.exr"), ramp));
    write(c.file, c.mesh);
    const std::string path_tracer = "<integrator type=\"path\">" + integer("max_depth", 2) + "</integrator>";
    const std::string kind = std::string(c.file).ends_with("ply") ? "ply" : "obj";
    write("scene.xml",
          R"(<scene version="3.0.0">)" +
              (*c.aovs == 0 ? path_tracer
                            : R"(<integrator type="aov">)" + text("aovs", c.aovs) + path_tracer + "</integrator>") +
              camera(kSize) + "<shape type=\"" + kind + "\">" + text("filename", c.file) + c.inside + "</shape>" +
              R"(<emitter type="point"><point name="position" value="1, 0.5, 2"/></emitter></scene>)");
  }
};

TEST_P(Accelerators, ShowTheSame) {
  write_scene();
  const Scene scene = load(path("scene.xml"), {}, Warnings::expected);
  const auto render = [&](const char* accelerator) {
    // Every sample at the middle of a cell would meet the diagonal: Sobol' points do not.
    return render_image(scene, {.samples_per_pixel = 16, .threads = kThreads, .accelerator = accelerator}, true);
  };
  const Image wanted = render("moller_trumbore");
  bool any = false;
  for (const char* accelerator : {"planes", "bvh", "embree"}) {
    const Image got = render(accelerator);
    ASSERT_EQ(got.channels.size(), wanted.channels.size());
    for (std::size_t c = 0; c < wanted.channels.size(); ++c) {
      for (std::size_t i = 0; i < wanted.channels[c].values.size(); ++i) {
        const float a = got.channels[c].values[i], b = wanted.channels[c].values[i];
        any = any || b != 0;
        ASSERT_NEAR(a, b, 1e-4f * std::max(1.0f, std::abs(b)))
            << accelerator << ", " << wanted.channels[c].name << " of pixel " << i;
      }
    }
  }
  EXPECT_TRUE(any);
}

TEST_P(Accelerators, MergeWhatDiffersInNothing) {
  write_scene();
  const Scene scene = load(path("scene.xml"), {}, Warnings::expected);
  EXPECT_EQ(merge_triangles(scene.tables().tables, variation_of(scene.frame().layers)).size(), GetParam().polygons);
}

INSTANTIATE_TEST_SUITE_P(Meshes, Accelerators, ::testing::ValuesIn(kCases), kParamName);

class FarAway : public SceneFolder {};

/// Where planes, which would do for so few triangles, would make them visibly larger.
TEST_F(FarAway, SmallThingsKeepTheirSize) {
  const auto corner = [](double at, double x, double y) {
    return "v " + std::to_string(at + x) + " " + std::to_string(at + y) + " 0\n";
  };
  const auto triangle = [&](double at) { return corner(at, -0.5, -0.5) + corner(at, 0.5, -0.5) + corner(at, 0, 0.5); };
  write("m.obj", triangle(0) + "f 1 2 3\n");
  write("parts.obj", triangle(3000) + triangle(-3000) + "f 1 2 3\nf 4 5 6\n");
  const auto covered = [&](const std::string& file, const std::string& at, const std::string& moved) {
    const View view{.origin = at + ", " + at + ", 4", .target = at + ", " + at + ", 0"};
    const std::string place =
        R"(<transform name="to_world"><translate x=")" + moved + R"(" y=")" + moved + R"("/></transform>)";
    const Scene scene = load_elements(R"(<integrator type="path"><integer name="max_depth" value="1"/></integrator>)" +
                                      camera(32, view) + R"(<shape type="obj">)" + text("filename", file) + place +
                                      R"(<emitter type="area"/></shape>)");
    double sum = 0;
    const Image image = render_image(scene, {.samples_per_pixel = 256, .threads = kThreads});
    for (const float value : image.find("R")->values) sum += static_cast<double>(value);
    return sum;
  };
  // The image's samples know the area to 0.03 % at either place; planes are 2 % off.
  const double wanted = covered("m.obj", "0", "0");
  EXPECT_NEAR(covered("m.obj", "3000", "3000") / wanted, 1, 2e-3);
  EXPECT_NEAR(covered("parts.obj", "3000", "0") / wanted, 1, 2e-3) << "a mesh whose parts are small";
}

class OnALargeFloor : public SceneFolder {};

/// A pyramid hides the sky from the floor around it, however large the floor is, and shows in it where it stands.
TEST_F(OnALargeFloor, ThingsStand) {
  write("pyramid.obj",
        "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0 0.5\nv -0.5 0 0.5\nv 0 1 0\nf 5 2 1\nf 5 3 2\nf 5 4 3\nf 5 1 4\n");
  const auto picture = [&](const char* size, const char* accelerator) {
    const Scene scene = load_elements(R"(<integrator type="path"><integer name="max_depth" value="3"/></integrator>)" +
                                      camera(kSize, {.origin = "0.1, 1.2, -4", .target = "0, 0.2, 0"}) +
                                      R"(<shape type="obj">)" + text("filename", "pyramid.obj") + kGrey + "</shape>" +
                                      R"(<shape type="rectangle"><transform name="to_world"><scale value=")" + size +
                                      R"("/><rotate x="1" angle="-90"/></transform>)" + kGrey +
                                      R"(</shape><emitter type="constant"/>)");
    return render_image(scene,
                        {.samples_per_pixel = 16, .threads = kThreads, .accelerator = accelerator, .features = true});
  };
  const Image wanted = picture("100", "planes");
  for (const char* accelerator : {"bvh", "embree", "moller_trumbore"}) {
    for (const char* size : {"100", "10000", "1000000"}) {
      const Image got = picture(size, accelerator);
      for (const char* layer : {"G", "depth.Z"}) {
        const std::vector<float>&a = got.find(layer)->values, &b = wanted.find(layer)->values;
        // From half of the height down: all of the nearer floor.
        for (std::size_t i = a.size() / 2; i < a.size(); ++i) {
          ASSERT_NEAR(a[i], b[i], 1e-3f * std::abs(b[i]))
              << accelerator << ", " << size << ", " << layer << " of " << i;
        }
      }
    }
  }
}

/// The room's triangles stay what they are made of.
TEST(AcceleratorsMerge, TheRoom) {
  const Scene scene = load("hexagon_room");
  EXPECT_EQ(merge_triangles(scene.tables().tables).size(), 13u);
}

}  // namespace
}  // namespace norrsken::end_to_end
