#include "shape/mesh_host.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::IsEmpty;
using ::testing::Pointwise;

std::string mesh(const std::string& file, const std::string& inside = "") {
  return "<shape type=\"" + file.substr(file.size() - 3) + "\"><string name=\"filename\" value=\"" + file + "\"/>" +
         inside + "</shape>";
}
std::string boolean(const std::string& name, const std::string& value) {
  return "<boolean name=\"" + name + "\" value=\"" + value + "\"/>";
}
std::string transform(const std::string& inside) { return "<transform name=\"to_world\">" + inside + "</transform>"; }

std::vector<float> plane(const Compiled& c, std::size_t triangle) {
  const auto& g = c.tables().surfaces.at(triangle).geometry;
  return {g[0], g[1], g[2], g[3]};
}

/// A triangle in the plane z = 2, facing up.
const std::string kTriangle = "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n";
/// Two walls of a right angle that share an edge and its vertices: the floor z = 0 and the wall x = 0.
const std::string kCorner = "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nv 0 1 1\nf 1 3 4 2\nf 1 2 6 5\n";

TEST(MeshShape, ReadsObj) {
  const Compiled c = compile_shape(mesh("a.obj"), {{"a.obj", kTriangle}});
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().triangle_count(), 1u);
  EXPECT_THAT(plane(c, 0), ElementsAre(0, 0, 1, 2));
}

TEST(MeshShape, TextureCoordinatesThatAFileDoesNotGiveGoByItsOrderOfCorners) {
  // As Mitsuba has them: 0 0, 1 0 and 0 1 at the first, second and third corner of the file.
  const auto uv_at = [](const Compiled& c) {
    std::map<std::vector<float>, std::vector<float>> found;
    const SceneTables& t = c.tables();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = t.triangle_vertices.at(k);
      const std::vector<float> uv = t.texcoords.empty()
                                        ? std::vector<float>{k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f}
                                        : std::vector<float>{t.texcoords[2 * v], t.texcoords[2 * v + 1]};
      found[{t.positions[3 * v], t.positions[3 * v + 1]}] = uv;
    }
    return found;
  };
  const std::string textured = R"(<bsdf type="diffuse"><texture name="reflectance" type="checkerboard"/></bsdf>)";
  const std::map<std::vector<float>, std::vector<float>> wanted = {
      {{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}};
  const std::string corners = "v 0 0 2\nv 1 0 2\nv 0 1 2\n";
  const std::string against = corners + "vn 0 0 -1\nvn 0.1 0 -1\nf 1//1 2//2 3//1\n";
  for (const std::string& obj : {kTriangle, against}) {
    for (const std::string& flip : {std::string(), boolean("flip_normals", "true")}) {
      EXPECT_EQ(uv_at(compile_shape(mesh("a.obj", flip + textured), {{"a.obj", obj}})), wanted) << obj << flip;
    }
  }
  const Compiled plain = compile_shape(mesh("a.obj"), {{"a.obj", against}});
  EXPECT_TRUE(plain.tables().texcoords.empty()) << "where nothing looks at them";
}

TEST(MeshShape, KnowsHowFarItsNormalsTurn) {
  const auto turned_below = [](const std::string& normal) {
    const std::string obj = "v 0 0 2\nv 1 0 2\nv 0 1 2\nvn 0 0 1\nvn " + normal + "\nf 1//1 2//2 3//1\n";
    return compile_shape(mesh("a.obj"), {{"a.obj", obj}}).tables().surfaces.at(0).turned_below;
  };
  EXPECT_NEAR(turned_below("0.6 0 0.8"), 0.6f, 2e-3f);
  EXPECT_GE(turned_below("0.6 0 0.8"), 0.6f);
  EXPECT_GT(turned_below("1 0 -0.5"), 1);
  EXPECT_LT(turned_below("0 0 1"), 0) << "flat";
}

TEST(MeshShape, KnowsItOfEachTriangle) {
  const std::string obj =
      "v 0 0 2\nv 1 0 2\nv 0 1 2\nv 1 1 2\nv 1 1e-3 2\nvn 0 0 1\nvn 0.6 0 0.8\n"
      "f 1//1 2//1 3//1\nf 2//1 4//1 3//2\nf 1//1 2//1 5//1\n";
  const Compiled c = compile_shape(mesh("a.obj"), {{"a.obj", obj}});
  EXPECT_NEAR(c.tables().surfaces.at(0).turned_below, 0, 2e-3f);
  EXPECT_NEAR(c.tables().surfaces.at(1).turned_below, 0.6f, 2e-3f);
  EXPECT_GT(c.tables().surfaces.at(2).turned_below, 1) << "in a sliver the normal may be anything";
}

TEST(MeshShape, ReadsPly) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 2\n1 0 2\n0 1 2\n3 0 1 2\n";
  const Compiled c = compile_shape(mesh("a.ply"), {{"a.ply", ply}});
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().triangle_count(), 1u);
  EXPECT_THAT(plane(c, 0), ElementsAre(0, 0, 1, 2));
}

TEST(MeshShape, FlipsTextureCoordinatesOfObjOnlyUnlessTold) {
  const std::string obj = "v 0 0 2\nv 1 0 2\nv 0 1 2\nvt 0 0.25\nf 1/1 2/1 3/1\n";
  EXPECT_FLOAT_EQ(compile_shape(mesh("a.obj"), {{"a.obj", obj}}).tables().texcoords.at(1), 0.75f);
  EXPECT_FLOAT_EQ(
      compile_shape(mesh("a.obj", boolean("flip_tex_coords", "false")), {{"a.obj", obj}}).tables().texcoords.at(1),
      0.25f);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 2 0 0.25\n1 0 2 0 0.25\n0 1 2 0 0.25\n3 0 1 2\n";
  EXPECT_FLOAT_EQ(compile_shape(mesh("a.ply"), {{"a.ply", ply}}).tables().texcoords.at(1), 0.25f);
  EXPECT_FLOAT_EQ(
      compile_shape(mesh("a.ply", boolean("flip_tex_coords", "true")), {{"a.ply", ply}}).tables().texcoords.at(1),
      0.75f);
}

TEST(MeshShape, IsPlaced) {
  const Compiled c = compile_shape(mesh("a.obj", transform(R"(<rotate x="1" angle="180"/><translate y="5"/>)")),
                                   {{"a.obj", kTriangle}});
  EXPECT_THAT(plane(c, 0), Pointwise(FloatNear(1e-6f), {0.0f, 0.0f, -1.0f, 2.0f}));
  EXPECT_NEAR(c.info().bounds_max[1], 5, 1e-6);
}

TEST(MeshShape, SharedVerticesAreSmoothAndSeparateOnesAreNot) {
  const Compiled smooth = compile_shape(mesh("a.obj"), {{"a.obj", kCorner}});
  ASSERT_THAT(smooth.messages(), IsEmpty());
  EXPECT_EQ(smooth.tables().shapes.at(0).smooth, 1u);
  ASSERT_EQ(smooth.tables().normals.size(), smooth.tables().positions.size());

  // The same with vertices of its own for each wall.
  const std::string apart =
      "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nf 1 3 4 2\nf 5 6 8 7\n";
  const Compiled flat = compile_shape(mesh("a.obj"), {{"a.obj", apart}});
  ASSERT_THAT(flat.messages(), IsEmpty());
  EXPECT_EQ(flat.tables().shapes.at(0).smooth, 0u);
  EXPECT_THAT(flat.tables().normals, IsEmpty());
}

TEST(MeshShape, FaceNormalsAreFlat) {
  const Compiled c = compile_shape(mesh("a.obj", boolean("face_normals", "true")), {{"a.obj", kCorner}});
  EXPECT_EQ(c.tables().shapes.at(0).smooth, 0u);
  EXPECT_THAT(c.tables().normals, IsEmpty());
}

TEST(MeshShape, NormalsAreWeighedWithAngles) {
  // Vertex 1 has a whole corner of 90 degrees of each wall, however the quads are split: its normal is the bisector.
  const Compiled c = compile_shape(mesh("a.obj"), {{"a.obj", kCorner}});
  const SceneTables& t = c.tables();
  int found = 0;
  for (std::size_t v = 0; v < t.positions.size() / 3; ++v) {
    if (t.positions[3 * v] != 0 || t.positions[3 * v + 2] != 0) continue;
    const float half = std::sqrt(0.5f);
    EXPECT_THAT(std::vector(&t.normals[3 * v], &t.normals[3 * v] + 3), Pointwise(FloatNear(1e-6f), {half, 0.0f, half}));
    ++found;
  }
  EXPECT_EQ(found, 2);
}

TEST(MeshShape, OwnNormalsAreTakenThroughTheInverseTranspose) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n";
  const Compiled c = compile_shape(mesh("a.obj", transform(R"(<scale x="2"/>)")), {{"a.obj", obj}});
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().shapes.at(0).smooth, 1u);
  const float length = std::sqrt(1.25f);
  EXPECT_THAT(std::vector(c.tables().normals.begin(), c.tables().normals.begin() + 3),
              Pointwise(FloatNear(1e-6f), {0.5f / length, 0.0f, 1 / length}));
}

TEST(MeshShape, WindingFollowsTheFilesNormals) {
  const std::string up = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
  const std::string contrary = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n";
  const std::string mirror = transform(R"(<scale x="-1"/>)");
  EXPECT_THAT(plane(compile_shape(mesh("a.obj"), {{"a.obj", up}}), 0), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(plane(compile_shape(mesh("a.obj"), {{"a.obj", contrary}}), 0), ElementsAre(0, 0, -1, 0));
  EXPECT_THAT(plane(compile_shape(mesh("a.obj", mirror), {{"a.obj", up}}), 0), ElementsAre(0, 0, 1, 0));
}

TEST(MeshShape, MirroredWithoutNormalsItIsInsideOut) {
  EXPECT_THAT(plane(compile_shape(mesh("a.obj", transform(R"(<scale x="-1"/>)")), {{"a.obj", kTriangle}}), 0),
              ElementsAre(0, 0, -1, -2));
}

TEST(MeshShape, IsFlippedWithItsNormals) {
  const Compiled flat = compile_shape(mesh("a.obj", boolean("flip_normals", "true")), {{"a.obj", kTriangle}});
  EXPECT_THAT(plane(flat, 0), ElementsAre(0, 0, -1, -2));
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n";
  const Compiled smooth = compile_shape(mesh("a.obj", boolean("flip_normals", "true")), {{"a.obj", obj}});
  EXPECT_THAT(plane(smooth, 0), ElementsAre(0, 0, -1, 0));
  EXPECT_NEAR(smooth.tables().normals.at(0), -std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(smooth.tables().normals.at(2), -std::sqrt(0.5f), 1e-6f);
}

TEST(MeshShape, SmoothAndFlatShapesShareTheNormalsArray) {
  const Compiled c = compile_shape(mesh("b.obj") + mesh("a.obj") + R"(<shape type="rectangle"/>)",
                                   {{"a.obj", kCorner}, {"b.obj", kTriangle}});
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  EXPECT_EQ(t.normals.size(), t.positions.size());
  EXPECT_EQ(t.texcoords.size() / 2, t.positions.size() / 3);
  EXPECT_THAT(std::vector(t.normals.begin(), t.normals.begin() + 9), Each(0.0f));
  // The rectangle came last and is the only one with texture coordinates.
  EXPECT_THAT(std::vector(t.texcoords.end() - 8, t.texcoords.end()), ElementsAre(0, 0, 1, 0, 1, 1, 0, 1));
}

/// A serialized file of one triangle in the plane z = 2 with normals (1, 0, 1); flags as given. Deflated without
/// compression: a stored block (RFC 1951, section 3.2.4) in zlib's frame (RFC 1950).
std::string serialized(std::uint32_t flags) {
  const auto bytes_of = [](auto value) { return std::string(reinterpret_cast<const char*>(&value), sizeof value); };
  std::string body = bytes_of(flags) + std::string("a\0", 2) + bytes_of(std::uint64_t{3}) + bytes_of(std::uint64_t{1});
  for (const float x : {0.f, 0.f, 2.f, 1.f, 0.f, 2.f, 0.f, 1.f, 2.f}) body += bytes_of(x);
  if ((flags & 1) != 0) {
    for (const float x : {1.f, 0.f, 1.f, 1.f, 0.f, 1.f, 1.f, 0.f, 1.f}) body += bytes_of(x);
  }
  for (const std::uint32_t vertex : {0, 1, 2}) body += bytes_of(vertex);
  const auto size = static_cast<std::uint16_t>(body.size());
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : body) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
  std::string sum = bytes_of(b << 16 | a);
  std::reverse(sum.begin(), sum.end());
  const std::string mesh = std::string("\x1c\x04\x04\0", 4) + "\x78\x01\x01" + bytes_of(size) +
                           bytes_of(static_cast<std::uint16_t>(~size)) + body + sum;
  return mesh + mesh + bytes_of(std::uint64_t{0}) + bytes_of(std::uint64_t{mesh.size()}) + bytes_of(std::uint32_t{2});
}
std::string serialized_shape(const std::string& inside = "") {
  return R"(<shape type="serialized"><string name="filename" value="a.serialized"/>)" + inside + "</shape>";
}

TEST(MeshShape, ReadsSerialized) {
  for (const char* index : {"", R"(<integer name="shape_index" value="1"/>)"}) {
    const Compiled c = compile_shape(serialized_shape(index), {{"a.serialized", serialized(0x1000)}});
    ASSERT_THAT(c.messages(), IsEmpty());
    EXPECT_THAT(plane(c, 0), ElementsAre(0, 0, 1, 2));
  }
}

TEST(MeshShape, SerializedMeshesMayAskForFaceNormals) {
  EXPECT_EQ(compile_shape(serialized_shape(), {{"a.serialized", serialized(0x1001)}}).tables().shapes.at(0).smooth, 1u);
  EXPECT_EQ(compile_shape(serialized_shape(), {{"a.serialized", serialized(0x1011)}}).tables().shapes.at(0).smooth, 0u);
}

TEST(MeshShape, SerializedHasParametersOfItsOwn) {
  const Files files{{"a.serialized", serialized(0x1000)}};
  EXPECT_THAT(compile_shape(serialized_shape(R"(<integer name="shape_index" value="2"/>)"), files).messages(),
              ElementsAre("error: there is no mesh 2 (named at scene.xml:2:165) ['shape_index' 0 to 1]"));
  EXPECT_THAT(compile_shape(serialized_shape(R"(<integer name="shape_index" value="-1"/>)"), files).messages(),
              ElementsAre("error: 'shape_index' is -1 [an integer from 0 to 4294967295]"));
  EXPECT_THAT(compile_shape(serialized_shape(R"(<float name="shape_index" value="1"/>)"), files).messages(),
              ElementsAre("error: 'shape_index' is a float [integer]"));
  EXPECT_THAT(compile_shape(serialized_shape(boolean("flip_tex_coords", "true")), files).messages(),
              ElementsAre("error: unused parameter 'flip_tex_coords' of shape 'serialized' "
                          "[face_normals, filename, flip_normals, shape_index, to_world]"));
  EXPECT_THAT(
      compile_shape(R"(<shape type="serialized"/>)").messages(),
      ElementsAre(
          "error: shape 'serialized' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
}

TEST(MeshShape, NormalsOfSliversAndTinyMeshesAreWeighedToo) {
  // A pyramid's tip: four faces of which two are slivers. The angles say how much each counts, at any scale.
  const std::string tip =
      "v 0 0 1\nv 1 -0.01 0\nv 1 0.01 0\nv -1 0.01 0\nv -1 -0.01 0\nf 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\n";
  for (const char* scale : {"1", "1e-12", "1e9"}) {
    const Compiled c =
        compile_shape(mesh("a.obj", transform(std::string("<scale value=\"") + scale + "\"/>")), {{"a.obj", tip}});
    ASSERT_THAT(c.messages(), IsEmpty()) << scale;
    const auto& n = c.tables().normals;
    EXPECT_THAT(std::vector(&n[0], &n[3]), Pointwise(FloatNear(1e-5f), {0.0f, 0.0f, 1.0f})) << scale;
    EXPECT_NEAR(std::hypot(n[3], n[4], n[5]), 1, 1e-6) << scale;
    EXPECT_GT(n[3], 0.5) << scale;
  }
}

TEST(MeshShape, DropsTrianglesWithoutAnArea) {
  const std::string some = kTriangle + "v 2 0 2\nf 1 2 4\nf 1 1 2\n";
  const Compiled c = compile_shape(mesh("a.obj"), {{"a.obj", some}});
  EXPECT_EQ(c.tables().triangle_count(), 1u);
  EXPECT_THAT(c.messages(), ElementsAre("warning: 2 of 3 triangles have no area and are left out"));
  const Compiled all = compile_shape(mesh("a.obj"), {{"a.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n"}});
  EXPECT_THAT(all.messages(), ElementsAre("warning: no triangle of the shape has an area, nothing of it is drawn"));
  EXPECT_EQ(all.tables().triangle_count(), 0u);
}

TEST(MeshShape, WithoutTrianglesItIsNothing) {
  // Beside another shape, as a light, and in a group.
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 2\n";
  const Compiled c = compile_shape(mesh("a.ply", R"(<emitter type="area"/>)") + mesh("b.obj") +
                                       R"(<shape type="shapegroup" id="g">)" + mesh("a.ply") + R"(</shape>
                                       <shape type="instance"><ref id="g"/></shape>)",
                                   {{"a.ply", ply}, {"b.obj", kTriangle}});
  EXPECT_THAT(c.messages(), Each(::testing::StartsWith("warning: the mesh has no faces, nothing of it is drawn")));
  EXPECT_EQ(c.tables().triangle_count(), 1u);
}

TEST(MeshShape, WhatIsNotFiniteIsLeftOutWithItsTriangles) {
  const Compiled c = compile_shape(mesh("a.obj"), {{"a.obj",
                                                    "v 0 0 2\nv 1 0 2\nv 0 1 2\nv nan 0 0\nvn nan 0 1\nvn 0 0 1\n"
                                                    "f 1//1 2//2 3//2\nf 1//2 3//2 4//2\n"}});
  ASSERT_EQ(c.messages().size(), 2u);
  EXPECT_EQ(c.messages()[1], "warning: 1 of 2 triangles has no area and is left out");
  EXPECT_EQ(c.tables().triangle_count(), 1u);
  EXPECT_THAT(plane(c, 0), ElementsAre(0, 0, 1, 2));
  EXPECT_EQ(c.tables().shapes.at(0).smooth, 0u) << "the missing normal is that of the face";
}

TEST(MeshShape, NormalsOfConcavePolygonsAreThoseOfTheirTriangles) {
  // Flat, so that all normals are alike: a fan would turn some over, whatever corner it began with.
  for (const char* face : {"f 1 2 3 4 5 6", "f 3 4 5 6 1 2", "f 5 6 1 2 3 4"}) {
    const Compiled c = compile_shape(
        mesh("a.obj"), {{"a.obj", std::string("v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n") + face}});
    EXPECT_EQ(c.tables().shapes.at(0).smooth, 0u) << face;
    EXPECT_EQ(c.tables().triangle_count(), 4u) << face;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_THAT(plane(c, i), ElementsAre(0, 0, 1, 0)) << face;
  }
}

TEST(MeshShape, RefusesVerticesFarBeyondTheScene) {
  EXPECT_THAT(compile_shape(mesh("a.obj", transform(R"(<scale value="1e12"/>)")),
                            {{"a.obj", "v 0 0 0\nv 1e9 0 0\nv 0 1e9 0\nf 1 2 3\n"}})
                  .messages(),
              ElementsAre("error: a vertex is at (1e+21, 0, 0) [coordinates from -1e+12 to 1e+12]"));
}

TEST(MeshShape, NeedsItsFile) {
  EXPECT_THAT(
      compile_shape(R"(<shape type="obj"/>)").messages(),
      ElementsAre("error: shape 'obj' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
  const auto missing = compile_shape(mesh("b.obj"), {{"a.obj", kTriangle}}).messages();
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_THAT(missing[0], ::testing::StartsWith("error: there is no file 'b.obj' [a file in "));
  EXPECT_THAT(compile_shape(mesh("folder.obj"), {{"folder.obj/a", ""}}).messages(),
              ElementsAre("error: cannot read 'folder.obj': is a folder [a readable obj file]"));
}

TEST(ComputeNormals, CancellingFacesLeaveNoNormal) {
  MeshData sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  compute_normals(sheet);
  EXPECT_THAT(sheet.normals, Each(std::array<float, 3>{0, 0, 0}));
}

TEST(MeshShape, VerticesWithoutAnyNormalTakeThatOfAFace) {
  const Compiled c = compile_shape(mesh("a.obj"), {{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n"}});
  ASSERT_EQ(c.tables().normals.size(), 9u);
  EXPECT_THAT(c.tables().normals, ElementsAre(0, 0, 1, 0, 0, 1, 0, 0, 1));
}

}  // namespace
}  // namespace norrsken::testing
