#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/mesh_readers.h"
#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Points = std::vector<std::array<float, 3>>;

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
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n"),
            "a.ply: error: the mesh has no vertices or no faces\naccepted: elements 'vertex' and 'face'");
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\nend_header\n"),
            "a.ply: error: vertices without a place\naccepted: properties x, y and z of element 'vertex'");
  EXPECT_EQ(complaints("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face 1\nproperty int a\nend_header\n"),
            "a.ply: error: faces without vertices\naccepted: a list property 'vertex_indices' of element 'face'");
  EXPECT_EQ(complaints(header("ascii", "3", "0") + kCorners),
            "a.ply: error: the mesh has no faces\naccepted: at least one");
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
  EXPECT_EQ(complaints(header("ascii", "3", "3") + "0 nan 0\n1 0 1e20\n1 1 0\n3 0 1 3\n3 0 -1 2\n2 0 1\n"),
            R"(a.ply:10:3: error: 'y' of vertex 0 is nan
   10 | 0 nan 0
      |   ^~~
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
accepted: 0 to 2
a.ply:15:1: error: face 2 has 2 vertices
   15 | 2 0 1
      | ^
accepted: at least 3 vertices)");
  EXPECT_EQ(complaints(header("ascii") + kCorners + "3 0 1\n"),
            "a.ply: error: the file ends in element 'face' 1 of 1\naccepted: as many as the header says");
}

TEST(PlyErrors, BinaryBody) {
  std::string bytes = header("binary_little_endian");
  for (const float value : {0.0f, 0.0f, INFINITY, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f}) bytes += bytes_of(value, false);
  bytes += bytes_of<std::uint8_t>(3, false);
  for (const std::int32_t index : {0, 1, 7}) bytes += bytes_of(index, false);
  EXPECT_EQ(complaints(bytes),
            "a.ply: error: 'z' of vertex 0 is inf\naccepted: a number from -1e+12 to 1e+12\n"
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
