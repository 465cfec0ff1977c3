// What each of pbrt's families becomes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/pbrt/lights.h"
#include "formats/pbrt/pbrt_testing.h"

namespace norrsken::pbrt {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string material(const std::string& parameters) {
  return node_of("bsdf", "Material " + parameters + "\nShape \"sphere\"");
}

std::shared_ptr<const Mesh> mesh_of(const std::string& world) {
  const auto shape = find_node("shape", "WorldBegin\n" + world);
  if (shape) {
    for (const Property& property : shape->properties) {
      if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&property.value)) return *mesh;
    }
  }
  ADD_FAILURE() << "no mesh";
  return std::make_shared<const Mesh>();
}

/// The normal of a mesh's first triangle, by its corners.
std::array<float, 3> front_of(const Mesh& mesh) {
  const auto p = [&](std::size_t k, std::size_t c) { return mesh.positions[3 * mesh.triangles[k] + c]; };
  std::array<float, 3> n{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t i = (c + 1) % 3, j = (c + 2) % 3;
    n[c] = (p(1, i) - p(0, i)) * (p(2, j) - p(0, j)) - (p(1, j) - p(0, j)) * (p(2, i) - p(0, i));
  }
  return n;
}

TEST(PbrtMaterials, ModelsAreOursWhereThereIsOne) {
  EXPECT_EQ(material("\"diffuse\" \"rgb reflectance\" [ .1 .2 .3 ]"),
            "bsdf twosided ''\n  bsdf diffuse ''\n    reflectance = rgb 0.1 0.2 0.3\n");
  EXPECT_EQ(material("\"dielectric\""), "bsdf dielectric ''\n  ext_ior = 1\n  int_ior = 1.5\n");
  EXPECT_THAT(material("\"dielectric\" \"spectrum eta\" \"glass-BK7\" \"float roughness\" .04"),
              AllOf(HasSubstr("roughdielectric"), HasSubstr("int_ior = 1.5168\n"), HasSubstr("alpha_u = 0.2\n"),
                    HasSubstr("distribution = ggx\n")));
  EXPECT_THAT(material("\"conductor\""), AllOf(HasSubstr("bsdf conductor"), HasSubstr("material = Cu\n")));
  EXPECT_THAT(material("\"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float "
                       "uroughness\" .3 \"float vroughness\" .2 \"bool remaproughness\" false"),
              AllOf(HasSubstr("roughconductor"), HasSubstr("material = Au\n"), HasSubstr("alpha_u = 0.3\n"),
                    HasSubstr("alpha_v = 0.2\n")));
  EXPECT_THAT(material("\"conductor\" \"rgb reflectance\" [ .5 .5 .5 ]"),
              AllOf(HasSubstr("eta = rgb 1 1 1\n"), HasSubstr("k = rgb 2 2 2\n")));
  EXPECT_THAT(material("\"thindielectric\" \"float eta\" 1.3"), HasSubstr("int_ior = 1.3\n"));
  EXPECT_EQ(material("\"interface\""), "bsdf null ''\n");
  EXPECT_THAT(material("\"coateddiffuse\""), AllOf(HasSubstr("bsdf plastic"), HasSubstr("nonlinear = true\n")));
  EXPECT_THAT(material("\"coateddiffuse\" \"float roughness\" .25"),
              AllOf(HasSubstr("roughplastic"), HasSubstr("alpha = 0.5\n")));
  EXPECT_THAT(material("\"diffusetransmission\" \"rgb reflectance\" [ .1 .1 .1 ] \"rgb transmittance\" [ .3 .3 .3 ]"),
              AllOf(HasSubstr("blendbsdf"), HasSubstr("weight = 0.75\n"), HasSubstr("reflectance = rgb 0.4 0.4 0.4\n"),
                    HasSubstr("base_color = rgb 0.4 0.4 0.4\n")));
}

TEST(PbrtMaterials, MixesAreMadeOfNamedOnes) {
  EXPECT_EQ(node_of("bsdf",
                    "MakeNamedMaterial \"a\" \"string type\" \"dielectric\"\nMakeNamedMaterial \"b\" \"string type\" "
                    "\"diffuse\"\n"
                    "Material \"mix\" \"string materials\" [ \"a\" \"b\" ] \"float amount\" .25\nShape \"sphere\""),
            "bsdf blendbsdf ''\n  weight = 0.25\n  bsdf dielectric ''\n    ext_ior = 1\n    int_ior = 1.5\n"
            "  bsdf twosided ''\n    bsdf diffuse ''\n      reflectance = rgb 0.5 0.5 0.5\n");
  EXPECT_THAT(
      node_of("bsdf",
              "NamedMaterial \"later\"\nShape \"sphere\"\nMakeNamedMaterial \"later\" \"string type\" \"dielectric\""),
      HasSubstr("dielectric"));
}

TEST(PbrtMaterials, HolesAndReliefStandAround) {
  EXPECT_THAT(node_of("bsdf", "Shape \"sphere\" \"float alpha\" .25"),
              AllOf(HasSubstr("bsdf mask"), HasSubstr("opacity = 0.25\n")));
  EXPECT_THAT(node_of("bsdf", "Shape \"sphere\" \"float alpha\" 1"), Not(HasSubstr("mask")));
  EXPECT_THAT(node_of("bsdf",
                      "Texture \"h\" \"float\" \"checkerboard\"\nMaterial \"diffuse\" \"texture displacement\" "
                      "\"h\"\nShape \"sphere\""),
              HasSubstr("bsdf bumpmap ''\n  texture bitmap 'texture'"));
  EXPECT_THAT(material("\"diffuse\" \"string normalmap\" \"n.png\""),
              AllOf(HasSubstr("normalmap"), HasSubstr("raw = true")));
}

TEST(PbrtShapes, RoundOnesAreThemselvesUntilTheyAreCut) {
  EXPECT_EQ(
      node_of("shape", "Shape \"sphere\" \"float radius\" 2"),
      "shape sphere ''\n  flip_normals = true\n  radius = 2\n  to_world = matrix 1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1\n"
      "  bsdf twosided ''\n    bsdf diffuse ''\n      reflectance = rgb 0.5 0.5 0.5\n");
  EXPECT_THAT(node_of("shape", "ReverseOrientation\nShape \"sphere\""), Not(HasSubstr("flip_normals")));
  EXPECT_THAT(node_of("shape", "Shape \"sphere\" \"float zmin\" 0"), HasSubstr("shape mesh"));
  EXPECT_THAT(node_of("shape", "Scale 1 2 1\nShape \"sphere\""), HasSubstr("shape mesh"));
  EXPECT_THAT(node_of("shape", "Shape \"disk\" \"float height\" 3"),
              AllOf(HasSubstr("shape disk"), HasSubstr("0 0 1 3 0 0 0 1")));
  EXPECT_THAT(node_of("shape", "Material \"conductor\" \"float uroughness\" .1\nShape \"disk\""),
              HasSubstr("shape mesh"));
  EXPECT_THAT(node_of("shape", "Shape \"cylinder\" \"float zmin\" -2"),
              AllOf(HasSubstr("p0 = 0 0 -2\n"), HasSubstr("p1 = 0 0 1\n")));
}

TEST(PbrtShapes, MirroringLeavesAMeshsFrontWhereItWas) {
  const std::string triangle = "\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]";
  EXPECT_GT(front_of(*mesh_of(triangle))[2], 0);
  EXPECT_LT(front_of(*mesh_of("ReverseOrientation" + triangle))[2], 0);
  EXPECT_GT(front_of(*mesh_of("Scale -1 1 1" + triangle))[2], 0);
  EXPECT_LT(front_of(*mesh_of("Scale 1 1 -1" + triangle))[2], 0);
  EXPECT_LT(mesh_of("ReverseOrientation" + triangle + " \"normal N\" [ 0 0 1 0 0 1 0 0 1 ]")->normals[2], 0);
}

TEST(PbrtShapes, PatchesThatTwistAreCutFine) {
  EXPECT_EQ(mesh_of("Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]")->triangles.size(), 6u);
  EXPECT_EQ(mesh_of("Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 1 ]")->triangles.size(), 6u * 16 * 16);
}

TEST(PbrtShapes, SubdivisionGoesToTheLimit) {
  // An octahedron's vertices have four neighbours: beta 3/32, so the limit is (1 - 4 g) v + g sum, g = 1 / (4 + 4).
  const std::string octahedron =
      "Shape \"loopsubdiv\" \"integer levels\" 0 \"point3 P\" [ 1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1 ]"
      " \"integer indices\" [ 0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5 ]";
  const auto mesh = mesh_of(octahedron);
  EXPECT_NEAR(mesh->positions[0], 0.5, 1e-6);
  EXPECT_EQ(mesh_of(std::string(octahedron).replace(octahedron.find("levels\" 0") + 8, 1, "2"))->triangles.size(),
            3u * 8 * 16);
}

TEST(PbrtShapes, CurvesAreAsWideAsTheySay) {
  const auto mesh = mesh_of(
      "Shape \"curve\" \"string type\" \"ribbon\" \"point3 P\" [ 0 0 0 1 0 0 2 0 0 3 0 0 ] \"normal N\" [ 0 0 1 0 0 1 "
      "] \"float width\" .5");
  EXPECT_EQ(mesh->triangles.size(), 6u);
  float least = 1, most = -1;
  for (std::size_t i = 1; i < mesh->positions.size(); i += 3)
    least = std::min(least, mesh->positions[i]), most = std::max(most, mesh->positions[i]);
  EXPECT_NEAR(most - least, 0.5, 1e-6);
}

TEST(PbrtTextures, ImagesAreNamedWhereNothingIsDoneToThem) {
  const std::string pfm = "PF\n1 1\n-1\n" + std::string(12, '\0');
  const auto texture = [&](const std::string& parameters) {
    return node_of("texture",
                   "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.pfm\" " + parameters +
                       "\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"",
                   {{"a.pfm", pfm}});
  };
  EXPECT_EQ(texture("\"float uscale\" 3 \"float vdelta\" .25"),
            "texture bitmap ''\n  filename = a.pfm\n  to_uv = matrix 3 0 0 0 0 -1 0 0.75 0 0 1 0 0 0 0 1\n");
  EXPECT_THAT(texture("\"string filter\" \"point\" \"string wrap\" \"clamp\""),
              AllOf(HasSubstr("nearest"), HasSubstr("clamp")));
  EXPECT_THAT(texture("\"float scale\" 2"), HasSubstr("image = an array"));
}

TEST(PbrtTextures, ConstantTreesAreNumbers) {
  EXPECT_THAT(
      node_of("bsdf",
              "Texture \"a\" \"spectrum\" \"constant\" \"rgb value\" [ .2 .4 .6 ]\nTexture \"h\" \"float\" "
              "\"constant\" \"float value\" .5\n"
              "Texture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \"texture scale\" \"h\"\n"
              "Texture \"c\" \"spectrum\" \"mix\" \"texture tex1\" \"a\" \"texture tex2\" \"b\" \"float amount\" .5\n"
              "Material \"diffuse\" \"texture reflectance\" \"c\"\nShape \"sphere\""),
      HasSubstr("reflectance = rgb 0.15 0.3 0.45\n"));
}

TEST(PbrtCamera, TheFieldOfViewIsThatOfTheShorterSide) {
  const auto fov = [](const std::string& film, const std::string& camera = {}) {
    const std::string text = node_of_scene(
        "sensor", "Camera \"perspective\" \"float fov\" 60 " + camera + "\nFilm \"rgb\" " + film + "\nWorldBegin");
    return std::stod(text.substr(text.find("  fov = ") + 8));
  };
  EXPECT_NEAR(fov("\"integer xresolution\" 100 \"integer yresolution\" 200"), 60, 1e-6);
  EXPECT_NEAR(std::tan(fov("\"integer xresolution\" 200 \"integer yresolution\" 100") * std::numbers::pi / 360),
              2 * std::tan(std::numbers::pi / 6), 1e-6);
  EXPECT_NEAR(std::tan(fov("\"integer xresolution\" 100 \"integer yresolution\" 100",
                           "\"float screenwindow\" [ -.5 .5 -.5 .5 ]") *
                       std::numbers::pi / 360),
              .5 * std::tan(std::numbers::pi / 6), 1e-6);
}

TEST(PbrtCamera, KindsBecomeOurs) {
  EXPECT_THAT(node_of_scene(
                  "sensor",
                  "Scale 2 2 2\nCamera \"perspective\" \"float lensradius\" .2 \"float focaldistance\" 6\nWorldBegin"),
              AllOf(HasSubstr("thinlens"), HasSubstr("aperture_radius = 0.1\n"), HasSubstr("focus_distance = 3\n")));
  EXPECT_THAT(node_of_scene("sensor",
                            "Camera \"orthographic\" \"float screenwindow\" [ -3 3 -3 3 ]\nFilm \"rgb\" \"integer "
                            "xresolution\" 8 \"integer yresolution\" 8\nWorldBegin"),
              AllOf(HasSubstr("orthographic"), HasSubstr("matrix -3 0 0 0 0 3 0 0 0 0 1 0 0 0 0 1")));
  // One thin glass of index 1.5 and radii of 100 mm: 100 mm of focal length.
  EXPECT_THAT(messages_of("Camera \"realistic\" \"string lensfile\" \"lens.dat\"\nWorldBegin",
                          {{"lens.dat", "# radius ...\n100 0 1.5 20\n-100 90 1 20\n"}}),
              HasSubstr("a thin lens of 100 mm"));
}

TEST(PbrtSettings, DefaultsAreThoseOfPbrt) {
  EXPECT_THAT(node_of_scene("integrator", "WorldBegin"), HasSubstr("bounces = 5\n"));
  EXPECT_THAT(node_of_scene("sampler", "WorldBegin"),
              AllOf(HasSubstr("sampler sobol"), HasSubstr("sample_count = 16\n")));
  EXPECT_THAT(node_of_scene("rfilter", "WorldBegin"), AllOf(HasSubstr("gaussian"), HasSubstr("stddev = 0.5\n")));
  EXPECT_THAT(node_of_scene("film", "WorldBegin"), AllOf(HasSubstr("width = 1280\n"), HasSubstr("height = 720\n")));
  EXPECT_THAT(node_of_scene("rfilter", "PixelFilter \"triangle\"\nWorldBegin"), HasSubstr("radius = 2\n"));
  EXPECT_THAT(node_of_scene("sampler", "Sampler \"stratified\" \"integer xsamples\" 3\nWorldBegin"),
              HasSubstr("sample_count = 12\n"));
  EXPECT_THAT(
      node_of_scene("film",
                    "Film \"rgb\" \"float cropwindow\" [ .25 .5 0 1 ] \"integer xresolution\" 100 \"integer "
                    "yresolution\" 50\nWorldBegin"),
      AllOf(HasSubstr("crop_offset_x = 25\n"), HasSubstr("crop_width = 25\n"), HasSubstr("crop_height = 50\n")));
}

TEST(PbrtLights, TheEqualAreaMapIsItsOwnInverse) {
  for (int i = 0; i < 400; ++i) {
    const glm::dvec2 at((i % 20 + 0.37) / 20, (i / 20 + 0.61) / 20);
    const glm::dvec3 direction = direction_of_square(at);
    EXPECT_NEAR(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z, 1, 1e-12);
    const glm::dvec2 back = square_of_direction(direction);
    EXPECT_NEAR(back.x, at.x, 1e-9);
    EXPECT_NEAR(back.y, at.y, 1e-9);
  }
}

}  // namespace
}  // namespace norrsken::pbrt
