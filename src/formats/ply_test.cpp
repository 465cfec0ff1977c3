#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/mesh_readers.h"
#include "formats/mesh_testing.h"
#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using Triangles = Array<std::array<std::uint32_t, 3>>;
using Points = Array<std::array<float, 3>>;

MeshData read(const std::string& bytes) {
  Diagnostics diagnostics;
  auto mesh = read_ply(bytes, "a.ply", diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  return mesh.value_or(MeshData{});
}

std::string complaints(const std::string& bytes) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_ply(bytes, "a.ply", diagnostics).has_value());
  return to_text(diagnostics);
}

/// A mesh that is read, and the warnings that come with it.
std::pair<MeshData, std::string> read_with_warnings(const std::string& bytes) {
  Diagnostics diagnostics;
  auto mesh = read_ply(bytes, "a.ply", diagnostics);
  EXPECT_TRUE(mesh.has_value() && !diagnostics.has_errors());
  return {mesh.value_or(MeshData{}), to_text(diagnostics)};
}

template <typename T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string header(const std::string& format, const std::string& vertices = "3", const std::string& faces = "1") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string kCorners = "0 0 0\n1 0 0\n1 1 0\n";

TEST(Ply, Ascii) {
  const MeshData mesh = read(header("ascii", "4") + "0 0 0\r\n1.5 0 -2e1\n1 1 0  0 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(mesh.positions, (Points{{0, 0, 0}, {1.5f, 0, -20}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Ply, BinaryOfBothByteOrders) {
  for (const bool big : {false, true}) {
    std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian");
    for (const float value : {0.0f, 0.0f, 0.0f, 1.5f, 0.0f, -20.0f, 1.0f, 1.0f, 0.0f}) bytes += bytes_of(value, big);
    bytes += bytes_of<std::uint8_t>(3, big);
    for (const std::int32_t index : {2, 0, 1}) bytes += bytes_of(index, big);
    const MeshData mesh = read(bytes);
    EXPECT_EQ(mesh.positions, (Points{{0, 0, 0}, {1.5f, 0, -20}, {1, 1, 0}})) << big;
    EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}})) << big;
  }
}

TEST(Ply, EveryTypeAndWhatIsSkipped) {
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
                        " 1.0\r\ncomment made by hand\r\nobj_info x\r\n"
                        "element material 1\r\nproperty list ushort short values\r\nproperty uint8 id\r\n"
                        "element face 1\r\nproperty int16 flags\r\nproperty list uint ushort vertex_index\r\n"
                        "element vertex 3\r\nproperty double x\r\nproperty char y\r\nproperty uint32 z\r\n"
                        "property float32 confidence\r\nproperty float nx\r\nproperty float ny\r\nproperty float nz\r\n"
                        "property int s\r\nproperty float t\r\nproperty list int8 double weights\r\nend_header\r\n";
    bytes += bytes_of<std::uint16_t>(2, big) + bytes_of<std::int16_t>(7, big) + bytes_of<std::int16_t>(8, big) + "i";
    bytes += bytes_of<std::int16_t>(-1, big) + bytes_of<std::uint32_t>(3, big);
    for (const int index : {0, 1, 2}) bytes += bytes_of(static_cast<std::uint16_t>(index), big);
    for (int i = 0; i < 3; ++i) {
      bytes += bytes_of(0.5 + i, big) + bytes_of(static_cast<std::int8_t>(-i), big);
      bytes += bytes_of<std::uint32_t>(3000000000u, big) + bytes_of(std::nanf(""), big);
      bytes += bytes_of(0.0f, big) + bytes_of(1.0f, big) + bytes_of(0.0f, big);
      bytes += bytes_of<std::int32_t>(-5, big) + bytes_of(0.25f, big);
      bytes += bytes_of<std::int8_t>(1, big) + bytes_of(1.0, big);
    }
    const MeshData mesh = read(bytes);
    EXPECT_EQ(mesh.positions, (Points{{0.5f, 0, 3e9f}, {1.5f, -1, 3e9f}, {2.5f, -2, 3e9f}})) << big;
    EXPECT_EQ(mesh.normals, (Points{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}})) << big;
    EXPECT_EQ(mesh.texcoords.at(2), (std::array<float, 2>{-5, 0.25f})) << big;
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}})) << big;
  }
}

const std::string kL = "0 0 0\n3 0 0\n3 1 0\n1 1 0\n1 3 0\n0 3 0\n";

TEST(Ply, ConcavePolygonsAreCoveredOnce) {
  for (const char* face : {"6 0 1 2 3 4 5\n", "6 1 2 3 4 5 0\n", "6 2 3 4 5 0 1\n", "6 4 5 0 1 2 3\n"})
    EXPECT_EQ(area2(read(header("ascii", "6") + kL + face)), 10) << face;
  EXPECT_EQ(area2(read("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 6\n"
                       "property float x\nproperty float y\nproperty float z\nend_header\n6 1 2 3 4 5 0\n" +
                       kL)),
            10)
      << "before its vertices";
}

TEST(Ply, TextureCoordinatesGoByManyNames) {
  for (const auto& [u, v] : {std::pair{"u", "v"},
                             {"s", "t"},
                             {"texture_u", "texture_v"},
                             {"texture_s", "texture_t"},
                             {"texcoord_s", "texcoord_t"},
                             {"texcoord_u", "texcoord_v"}}) {
    const MeshData mesh =
        read(std::string("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                         "property float z\nproperty float ") +
             u + "\nproperty float " + v +
             "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
             "0 0 0 0.5 0.25\n1 0 0 0 0\n1 1 0 0 0\n3 0 1 2\n");
    ASSERT_EQ(mesh.texcoords.size(), 3u) << u;
    EXPECT_EQ(mesh.texcoords[0], (std::array<float, 2>{0.5f, 0.25f})) << u;
    EXPECT_TRUE(mesh.attributes.empty()) << u;
  }
}

TEST(Ply, WhatIsNotFiniteIsLeftOut) {
  const auto [mesh, warning] =
      read_with_warnings(header("ascii", "4", "2") + kCorners + "nan inf 0\n3 0 1 2\n3 0 2 3\n");
  EXPECT_EQ(
      warning,
      R"(a.ply:13:1: warning: 'x' of vertex 3 is nan: vertices that are not finite are left out with their triangles, other values are taken for 0; the first of 2 such places
   13 | nan inf 0
      | ^~~)");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {3, 3, 3}}));
  EXPECT_EQ(mesh.positions.at(3), (std::array<float, 3>{0, 0, 0}));
  std::string bytes = header("binary_little_endian");
  for (const float value : {0.0f, 0.0f, INFINITY, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f}) bytes += bytes_of(value, false);
  bytes += bytes_of<std::uint8_t>(3, false);
  for (const std::int32_t index : {0, 1, 2}) bytes += bytes_of(index, false);
  EXPECT_EQ(read_with_warnings(bytes).first.triangles, (Triangles{{0, 0, 0}}));
}

TEST(Ply, ByteOrderMarksAreSkipped) {
  EXPECT_EQ(read("\xEF\xBB\xBF" + header("ascii") + kCorners + "3 0 1 2\n").triangles, (Triangles{{0, 1, 2}}));
}

TEST(Ply, FacesOfTwoCornersAreLeftOut) {
  const auto [mesh, warning] = read_with_warnings(header("ascii", "3", "2") + kCorners + "2 0 1\n3 0 1 2\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(warning, "a.ply:13:1: warning: a face of 2 vertices is left out\n   13 | 2 0 1\n      | ^");
}

TEST(Ply, MeshesOfNothingAreEmpty) {
  const std::string expected = "a.ply: warning: the mesh has no faces, nothing of it is drawn";
  EXPECT_EQ(read_with_warnings(header("ascii", "3", "0") + kCorners).second, expected);
  EXPECT_EQ(read_with_warnings(header("ascii", "0", "0")).second, expected);
  EXPECT_EQ(read_with_warnings("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n0 0 0\n")
                .second,
            expected)
      << "points";
}

TEST(PlyErrors, TriangleStripsAreNamed) {
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                       "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                       kCorners + "3 0 1 2\n"),
            "a.ply: error: triangle strips (element 'tristrips') are not read\naccepted: faces, in an element 'face'");
}

/// Names of attributes, with the values behind them: "vertex_color: 1 0 0".
std::vector<std::string> attributes(const MeshData& mesh) {
  std::vector<std::string> texts;
  for (const MeshAttribute& attribute : mesh.attributes) {
    EXPECT_EQ(attribute.per_face, attribute.name.starts_with("face_"));
    EXPECT_EQ(attribute.values.size(),
              attribute.channels * (attribute.per_face ? mesh.triangles.size() : mesh.positions.size()));
    texts.push_back(attribute.name + ":" + std::to_string(attribute.channels));
    for (const float value : attribute.values) texts.back() += fmt::format(" {:.4g}", value);
  }
  return texts;
}

/// An ascii file whose three vertices and two faces, a triangle and a quadrilateral, have these properties too.
MeshData with_properties(const std::string& of_vertices, const std::string& vertex_values, const std::string& of_faces,
                         const std::string& face_values) {
  const auto properties = [](const std::string& names, const char* type) {
    std::string text;
    for (std::size_t i = 0; i < names.size();) {
      const std::size_t end = std::min(names.find(' ', i), names.size());
      text += std::string("property ") + type + " " + names.substr(i, end - i) + "\n";
      i = end + 1;
    }
    return text;
  };
  return read("ply\nformat ascii 1.0\nelement vertex 4\n" + properties("x y z " + of_vertices, "float") +
              "element face 2\n" + properties(of_faces, "double") +
              "property list uchar int vertex_indices\nend_header\n" + "0 0 0 " + vertex_values + "\n1 0 0 " +
              vertex_values + "\n1 1 0 " + vertex_values + "\n0 1 0 " + vertex_values + "\n" + face_values +
              " 3 0 1 2\n" + face_values + " 4 0 1 2 3\n");
}

TEST(PlyAttributes, AreGroupedByTheirNames) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(attributes(with_properties("r g b", "1 0.5 0", "weight_0 flow_x flow_y flow_z", "7 1 2 3")),
            (Texts{"vertex_color:3 1 0.5 0 1 0.5 0 1 0.5 0 1 0.5 0", "face_weight:1 7 7 7",
                   "face_flow:3 1 2 3 1 2 3 1 2 3"}));
  EXPECT_EQ(attributes(with_properties("red green blue alpha", "1 2 3 4", "a_b_1 a_b_2 a_b_3", "4 5 6")),
            (Texts{"vertex_color:3 1 2 3 1 2 3 1 2 3 1 2 3", "face_a_b:3 4 5 6 4 5 6 4 5 6"}));
  EXPECT_EQ(attributes(with_properties("", "", "glow_r glow_g glow_b", "1 2 3")),
            (Texts{"face_glow_color:3 1 2 3 1 2 3 1 2 3"}));
}

TEST(PlyAttributes, GroupsOfTwoOrFourAndOtherNamesAreNone) {
  EXPECT_TRUE(
      attributes(with_properties("pair_0 pair_1 quality", "1 2 3", "four_x four_y four_z four_w", "1 2 3 4")).empty());
  EXPECT_TRUE(attributes(with_properties("r g", "1 2", "n_2 n_long", "1 2")).empty());
  // Of one name the first counts; a group ends where another begins.
  EXPECT_EQ(attributes(with_properties("a_0 b_0 a_1", "1 2 3", "", "")),
            (std::vector<std::string>{"vertex_a:1 1 1 1 1", "vertex_b:1 2 2 2 2"}));
}

TEST(PlyAttributes, IntegersAreStoredColours) {
  const MeshData mesh = read(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty ushort w_0\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 255 188 0 65535\n1 0 0 255 188 0 0\n1 1 0 255 188 0 -5\n3 0 1 2\n");
  EXPECT_EQ(attributes(mesh),
            (std::vector<std::string>{"vertex_color:3 1 0.5029 0 1 0.5029 0 1 0.5029 0", "vertex_w:1 1 0 0"}));
}

TEST(PlyAttributes, ValuesOutOfRange) {
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                       "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                       "property float w_0\nend_header\n" +
                       kCorners + "3 0 1 2 1e99\n"),
            R"(a.ply:14:9: error: 'w_0' of face 0 is 1e99
   14 | 3 0 1 2 1e99
      |         ^~~~
accepted: a number from -3.40282e+38 to 3.40282e+38)");
}

TEST(Ply, TextureCoordinatesOfTheFirstPairOfNames) {
  const MeshData mesh = with_properties("s t texture_u v texture_v", "1 2 3 4 5", "", "");
  EXPECT_EQ(mesh.texcoords.at(0), (std::array<float, 2>{3, 5}));
  EXPECT_EQ(with_properties("u t", "1 2", "", "").texcoords.size(), 0u);
}

TEST(PlyErrors, Header) {
  EXPECT_EQ(complaints("v 0 0 0\n"), "a.ply: error: this is no PLY file\naccepted: a file whose first line is 'ply'");
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\n"),
            "a.ply: error: the header has no end\naccepted: a line 'end_header'");
  EXPECT_EQ(complaints("ply\nend_header\n"),
            "a.ply: error: the header has no format\naccepted: a line 'format ascii 1.0' or the like");
  EXPECT_EQ(complaints("ply\nformat binary 1.0\n"), R"(a.ply:2:8: error: unknown format 'binary'
    2 | format binary 1.0
      |        ^~~~~~
accepted: ascii, binary_little_endian, binary_big_endian)");
  EXPECT_EQ(complaints("ply\nformat ascii 2.0\n"), R"(a.ply:2:14: error: version '2.0'
    2 | format ascii 2.0
      |              ^~~
accepted: 1.0)");
  EXPECT_EQ(complaints("ply\nelement vertex -1\n"), R"(a.ply:2:16: error: '-1' is no count
    2 | element vertex -1
      |                ^~
accepted: an integer of at least 0)");
  EXPECT_EQ(complaints("ply\nproperty float x\n"), R"(a.ply:2:1: error: a property before any element
    2 | property float x
      | ^~~~~~~~~~~~~~~~
accepted: an 'element' line first)");
  EXPECT_EQ(complaints("ply\nelement vertex 3\nproperty float\n"), R"(a.ply:3:1: error: a property has a type and a name
    3 | property float
      | ^~~~~~~~~~~~~~
accepted: property float x, property list uchar int vertex_indices)");
  EXPECT_EQ(complaints("ply\nelement vertex 3\nproperty real x\n"), R"(a.ply:3:10: error: unknown type 'real'
    3 | property real x
      |          ^~~~
accepted: char, uchar, short, ushort, int, uint, float, double, int8, uint8, int16, uint16, int32, uint32, float32, float64)");
  EXPECT_EQ(complaints("ply\nelement face 1\nproperty list float int vertex_indices\n"),
            R"(a.ply:3:15: error: 'float' is no type of a count
    3 | property list float int vertex_indices
      |               ^~~~~
accepted: an integer type)");
  EXPECT_EQ(complaints("ply\nhello\n"), R"(a.ply:2:1: error: unknown keyword 'hello'
    2 | hello
      | ^~~~~
accepted: comment, element, end_header, format, obj_info, property)");
}

TEST(PlyErrors, WhatAMeshNeeds) {
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement face 0\nproperty float x\nend_header\n"),
            "a.ply: error: the mesh has no vertices\naccepted: elements 'vertex' and 'face'");
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\nend_header\n"),
            "a.ply: error: vertices without a place\naccepted: properties x, y and z of element 'vertex'");
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face 1\nproperty int a\nend_header\n"),
            "a.ply: error: faces without vertices\naccepted: a list property 'vertex_indices' of element 'face'");
}

TEST(PlyErrors, AsciiBody) {
  EXPECT_EQ(complaints(header("ascii") + "0 0 0\n1 x 0\n"), R"(a.ply:11:3: error: 'x' is no number
   11 | 1 x 0
      |   ^
accepted: values as the header says)");
  EXPECT_EQ(complaints(header("ascii") + kCorners + "3 0 1 1.5\n"), R"(a.ply:13:7: error: '1.5' is no integer
   13 | 3 0 1 1.5
      |       ^~~
accepted: values as the header says)");
  EXPECT_EQ(complaints(header("ascii", "3", "3") + "0 0 1e99\n1 0 1e20\n1 1 0\n3 0 1 3\n3 0 -1 2\n3 0 1 2\n"),
            R"(a.ply:10:5: error: 'z' of vertex 0 is 1e99
   10 | 0 0 1e99
      |     ^~~~
accepted: a number from -1e+12 to 1e+12
a.ply:11:5: error: 'z' of vertex 1 is 1e20
   11 | 1 0 1e20
      |     ^~~~
accepted: a number from -1e+12 to 1e+12
a.ply:13:7: error: face 0 has a vertex 3
   13 | 3 0 1 3
      |       ^
accepted: 0 to 2
a.ply:14:5: error: face 1 has a vertex -1
   14 | 3 0 -1 2
      |     ^~
accepted: 0 to 2)");
  EXPECT_EQ(complaints(header("ascii") + kCorners + "3 0 1\n"),
            "a.ply: error: the file ends in element 'face' 1 of 1\naccepted: as many as the header says");
}

TEST(PlyErrors, BinaryBody) {
  std::string bytes = header("binary_little_endian");
  for (const float value : {0.0f, 0.0f, 1e13f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f}) bytes += bytes_of(value, false);
  bytes += bytes_of<std::uint8_t>(3, false);
  for (const std::int32_t index : {0, 1, 7}) bytes += bytes_of(index, false);
  EXPECT_EQ(complaints(bytes),
            "a.ply: error: 'z' of vertex 0 is 9999999827968\naccepted: a number from -1e+12 to 1e+12\n"
            "a.ply: error: face 0 has a vertex 7\naccepted: 0 to 2");
}

TEST(PlyErrors, CountsAreNotBelieved) {
  EXPECT_EQ(complaints(header("binary_little_endian", "4000000000", "9000000000000000000") + "x"),
            "a.ply: error: the file ends in element 'vertex' 1 of 4000000000\naccepted: as many as the header says");
  EXPECT_EQ(complaints(header("ascii", "5000000000") + "0"),
            "a.ply: error: 5000000000 vertices are too many\naccepted: fewer than 2^32");
  // A list that claims to be longer than the file, and an element without properties as often as one can say.
  EXPECT_EQ(complaints("ply\nformat binary_little_endian 1.0\nelement nothing 9000000000000000000\n" +
                       header("binary_little_endian", "0", "1").substr(36) + "\xFF" + std::string(8, '\0')),
            "a.ply: error: face 0 has a vertex 0\naccepted: no faces: there are no vertices\n"
            "a.ply: error: the file ends in element 'face' 1 of 1\naccepted: as many as the header says");
}

TEST(PlyErrors, EveryPrefixIsRefused) {
  std::string bytes = header("binary_little_endian");
  for (int i = 0; i < 9; ++i) bytes += bytes_of(static_cast<float>(i), false);
  bytes += bytes_of<std::uint8_t>(3, false);
  for (const std::int32_t index : {0, 1, 2}) bytes += bytes_of(index, false);
  EXPECT_EQ(read(bytes).triangles.size(), 1u);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_ply(bytes.substr(0, length), "a.ply", diagnostics).has_value()) << length;
    EXPECT_TRUE(diagnostics.has_errors()) << length;
  }
}

}  // namespace
}  // namespace norrsken
