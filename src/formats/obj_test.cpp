#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/mesh_readers.h"
#include "formats/mesh_testing.h"
#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using Triangles = Array<std::array<std::uint32_t, 3>>;
using Points = Array<std::array<float, 3>>;

MeshData read(const std::string& text) {
  Diagnostics diagnostics;
  auto mesh = read_obj(text, "a.obj", diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  return mesh.value_or(MeshData{});
}

std::string complaints(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_obj(text, "a.obj", diagnostics).has_value());
  return to_text(diagnostics);
}

/// A mesh that is read, and the warnings that come with it.
std::pair<MeshData, std::string> read_with_warnings(const std::string& text) {
  Diagnostics diagnostics;
  auto mesh = read_obj(text, "a.obj", diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  return {mesh.value_or(MeshData{}), to_text(diagnostics)};
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, Triangles) {
  const MeshData mesh = read("# a comment\no thing\nv 0 0 0\nv 1.5 -2e1 +3\nv .5 1. 1E-2\nusemtl m\ns off\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions, (Points{{0, 0, 0}, {1.5f, -20, 3}, {0.5f, 1, 0.01f}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.texcoords.empty());
}

TEST(Obj, PolygonsBecomeFans) {
  EXPECT_EQ(read(kSquare + "f 1 2 3 4").triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 5 1 2 3 4\n").triangles,
            (Triangles{{4, 0, 1}, {4, 1, 2}, {4, 2, 3}}));
}

const std::string kL = "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n";

TEST(Obj, ConcavePolygonsAreCoveredOnceWhereverTheyBegin) {
  for (int start = 0; start < 6; ++start) {
    std::string face = "f";
    for (int i = 0; i < 6; ++i) face += " " + std::to_string((start + i) % 6 + 1);
    EXPECT_EQ(area2(read(kL + face + "\n")), 10) << start;
    EXPECT_EQ(area2(read(face + "\n" + kL)), 10) << start << ", before its vertices";
  }
  EXPECT_EQ(area2(read("v 0 0 0\nv 1 3 0\nv 0 1 0\nv -1 3 0\nf 1 2 3 4\n")), 2) << "an arrowhead";
}

TEST(Obj, CornersOfConcavePolygonsKeepTheirParts) {
  // Texture coordinates are twice the position, normals say which corner it is.
  const MeshData mesh = read(kL + "vt 2 6\nvt 0 6\nvt 0 0\nvt 6 0\nvt 6 2\nvt 2 2\nvn 5 0 1\nvn 6 0 1\nvn 1 0 1\n" +
                             "vn 2 0 1\nvn 3 0 1\nvn 4 0 1\nf 5/1/1 6/2/2 1/3/3 2/4/4 3/5/5 4/6/6\n");
  EXPECT_EQ(area2(mesh), 10);
  ASSERT_EQ(mesh.texcoords.size(), 6u);
  for (std::size_t v = 0; v < 6; ++v) {
    EXPECT_EQ(mesh.texcoords[v], (std::array<float, 2>{2 * mesh.positions[v][0], 2 * mesh.positions[v][1]}));
  }
  const auto corner = std::ranges::find(mesh.positions, std::array<float, 3>{1, 3, 0}) - mesh.positions.begin();
  EXPECT_EQ(mesh.normals.at(static_cast<std::size_t>(corner))[0], 5);
}

TEST(Obj, ByteOrderMarkBeforeTheFirstVertex) {
  EXPECT_EQ(read("\xEF\xBB\xBF" + kSquare + "f 1 2 3\n").positions.at(0), (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(read("\xEF\xBB\xBF" + kSquare + "f 1 2 3 4\n").triangles.size(), 2u);
}

TEST(Obj, CarriageReturnsAloneEndLinesToo) {
  const MeshData mesh = read("# old\rv 0 0 0\rv 1 0 0\rv 1 \\\r 1 0\r\rf 1 2 3\r");
  EXPECT_EQ(mesh.positions, (Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(complaints("v 0 0 0\rv 1 0 x\r"), R"(a.obj:2:7: error: 'x' is not a number
    2 | v 1 0 x
      |       ^
accepted: a number such as 1.5 or -2e3)");
}

TEST(Obj, WhatIsNotFiniteIsLeftOut) {
  const std::string meaning =
      "is not finite: vertices that are not finite are left out with their triangles, other values are taken for 0";
  const auto [unused, warning] = read_with_warnings(kSquare + "v nan 0 0\nf 1 2 3\n");
  EXPECT_EQ(unused.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(warning, "a.obj:5:3: warning: 'nan' " + meaning + "\n    5 | v nan 0 0\n      |   ^~~");
  const auto [used, used_warning] = read_with_warnings(
      kSquare + "v nan 0 inf\nvt nan 1\nvt 1 1\nvn 0 nan 1\nf 1/2/1 2/1/1 3/2/1\nf 1/2/1 3/2/1 5/2/1\n");
  EXPECT_TRUE(used_warning.starts_with("a.obj:5:3: warning: 'nan' " + meaning + "; the first of 4 such places\n"));
  ASSERT_EQ(used.triangles.size(), 2u);
  EXPECT_EQ(used.triangles[1][0], used.triangles[1][1]) << "without an area";
  for (const auto& p : used.positions) EXPECT_TRUE(std::isfinite(p[0]) && std::isfinite(p[2]));
  EXPECT_EQ(used.texcoords.at(used.triangles[0][1]), (std::array<float, 2>{0, 0}));
  EXPECT_EQ(used.normals.at(used.triangles[0][1]), (std::array<float, 3>{0, 0, 0}));
}

TEST(Obj, FacesOfTwoCornersAreLeftOut) {
  const auto [mesh, warning] = read_with_warnings(kSquare + "f 1 2\nf 1 2 3\nf 4\nf\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(warning, R"(a.obj:5:1: warning: a face of 2 vertices is left out; the first of 3 such places
    5 | f 1 2
      | ^)");
}

TEST(Obj, NegativeIndicesCountBackFromTheFace) {
  EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -2 -1\n").triangles,
            (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Obj, FacesMayComeFirst) {
  EXPECT_EQ(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\n").triangles, (Triangles{{0, 1, 2}}));
}

TEST(Obj, LineEndingsContinuationsAndExtras) {
  const MeshData mesh =
      read("v 0 0 0 1\r\nv\t1 0 0 0.5 0.5 0.5\r\nv 1 \\\n 1 0 # corner\r\nvt 0.5\r\nf 1 \\\r\n 2 3 \r\n");
  EXPECT_EQ(mesh.positions, (Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_TRUE(mesh.texcoords.empty()) << "texture coordinates that no face uses";
}

TEST(Obj, VerticesWithOneIndexAreTakenAsTheyAre) {
  const MeshData mesh =
      read("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\nf 3/3/3 1/1/1 2/2/2\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}}));
  EXPECT_EQ(mesh.texcoords, (Array<std::array<float, 2>>{{0, 0}, {1, 0}, {1, 1}}));
  EXPECT_EQ(mesh.normals, (Points{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
}

TEST(Obj, CombinationsAreSharedWhereTheyAreEqual) {
  const MeshData mesh = read(kSquare + "vn 0 0 1\nvn 0 0 -1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\nf 1//2 2//2 3//2\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(mesh.positions, (Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.normals.at(3), (std::array<float, 3>{0, 0, 1}));
  EXPECT_EQ(mesh.normals.at(4), (std::array<float, 3>{0, 0, -1}));
}

TEST(Obj, CornersWithoutANormalGetTheirTriangles) {
  const MeshData mesh = read(kSquare + "vn 1 0 0\nvt 0.5 0.5\nf 1/1/1 2/1/1 3/1/1\nf 1 3 4\n");
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.texcoords.size(), mesh.positions.size());
  for (const std::uint32_t vertex : mesh.triangles.at(1)) {
    EXPECT_EQ(mesh.normals.at(vertex), (std::array<float, 3>{0, 0, 1}));
    EXPECT_EQ(mesh.texcoords.at(vertex), (std::array<float, 2>{0, 0}));
  }
  for (const std::uint32_t vertex : mesh.triangles.at(0))
    EXPECT_EQ(mesh.normals.at(vertex), (std::array<float, 3>{1, 0, 0}));
}

TEST(Obj, ManyCombinationsKeepTheirParts) {
  // Every corner must lead back to its own position and texture coordinates, through some hundred thousand of them.
  std::string text;
  const int count = 300;
  for (int i = 0; i < count; ++i) text += "v " + std::to_string(i) + " 0 0\nvt " + std::to_string(i) + " 1\n";
  std::vector<std::pair<int, int>> corners;
  for (int i = 1; i <= count; ++i) {
    for (int j = 1; j <= count; ++j) {
      const int k = j % count + 1;
      text += "f " + std::to_string(i) + "/" + std::to_string(j) + " " + std::to_string(k) + "/" + std::to_string(i) +
              " " + std::to_string(j) + "/" + std::to_string(k) + "\n";
      corners.insert(corners.end(), {{i, j}, {k, i}, {j, k}});
    }
  }
  const MeshData mesh = read(text);
  ASSERT_EQ(mesh.triangles.size() * 3, corners.size());
  EXPECT_LE(mesh.positions.size(), static_cast<std::size_t>(count) * count);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t vertex = mesh.triangles[i / 3][i % 3];
    ASSERT_EQ(mesh.positions.at(vertex)[0], static_cast<float>(corners[i].first - 1));
    ASSERT_EQ(mesh.texcoords.at(vertex)[0], static_cast<float>(corners[i].second - 1));
  }
}

TEST(ObjErrors, Numbers) {
  EXPECT_EQ(complaints("v 0 zero 0\nv 1 0 0\nv 1 0 1e99\nv 1 0 1e20\nv 1 0\nvt\nvn 1 0x1 0\n"),
            R"(a.obj:1:5: error: 'zero' is not a number
    1 | v 0 zero 0
      |     ^~~~
accepted: a number such as 1.5 or -2e3
a.obj:3:7: error: '1e99' is too large
    3 | v 1 0 1e99
      |       ^~~~
accepted: a number from -1e+12 to 1e+12
a.obj:4:7: error: '1e20' is too large
    4 | v 1 0 1e20
      |       ^~~~
accepted: a number from -1e+12 to 1e+12
a.obj:5:1: error: 'v' has 2 numbers
    5 | v 1 0
      | ^
accepted: 3 numbers
a.obj:6:1: error: 'vt' has 0 numbers
    6 | vt
      | ^~
accepted: at least one number
a.obj:7:6: error: '0x1' is not a number
    7 | vn 1 0x1 0
      |      ^~~
accepted: a number such as 1.5 or -2e3)");
}

TEST(ObjErrors, Faces) {
  EXPECT_EQ(complaints(kSquare + "f 1 2 3\nf 1 2 x\nf 1/2/3/4 2 3\nf /1 2 3\nf 1 2 1.5\n"),
            R"(a.obj:6:7: error: 'x' is no vertex of a face
    6 | f 1 2 x
      |       ^
accepted: p, p/t, p//n or p/t/n with indices
a.obj:7:3: error: '1/2/3/4' is no vertex of a face
    7 | f 1/2/3/4 2 3
      |   ^~~~~~~
accepted: p, p/t, p//n or p/t/n with indices
a.obj:8:3: error: '/1' is no vertex of a face
    8 | f /1 2 3
      |   ^~
accepted: p, p/t, p//n or p/t/n with indices
a.obj:9:7: error: '1.5' is no vertex of a face
    9 | f 1 2 1.5
      |       ^~~
accepted: p, p/t, p//n or p/t/n with indices
a.obj:7:5: error: there is no 'vt' number 2
    7 | f 1/2/3/4 2 3
      |     ^
accepted: no index: there are no 'vt' lines
a.obj:7:7: error: there is no 'vn' number 3
    7 | f 1/2/3/4 2 3
      |       ^
accepted: no index: there are no 'vn' lines
a.obj:8:4: error: there is no 'vt' number 1
    8 | f /1 2 3
      |    ^
accepted: no index: there are no 'vt' lines)");
}

TEST(ObjErrors, Indices) {
  EXPECT_EQ(complaints(kSquare + "f 1 2 0\nf 1 2 -5\nf 1 2 99999999999999999999\nf 1 2 5\n"),
            R"(a.obj:5:7: error: there is no 'v' number 0
    5 | f 1 2 0
      |       ^
accepted: 1 to 4, or -4 to -1 counted back from here
a.obj:6:7: error: there is no 'v' number -5
    6 | f 1 2 -5
      |       ^~
accepted: 1 to 4, or -4 to -1 counted back from here
a.obj:7:7: error: there is no 'v' number 99999999999999999999
    7 | f 1 2 99999999999999999999
      |       ^~~~~~~~~~~~~~~~~~~~
accepted: 1 to 4, or -4 to -1 counted back from here
a.obj:8:7: error: there is no 'v' number 5
    8 | f 1 2 5
      |       ^
accepted: 1 to 4, or -4 to -1 counted back from here)");
}

TEST(ObjErrors, NothingToSee) {
  const std::string expected = "a.obj: error: the file has no faces\naccepted: OBJ text with 'v' and 'f' lines";
  EXPECT_EQ(complaints(""), expected);
  EXPECT_EQ(complaints("v 0 0 0\n"), expected);
  EXPECT_EQ(complaints(std::string("\x7F"
                                   "ELF\0\0\xFF\n\xFE",
                                   9)),
            expected);
}

TEST(ObjErrors, TwentyAndMore) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "v x\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(read_obj(text, "a.obj", diagnostics).has_value());
  ASSERT_EQ(diagnostics.all().size(), 21u);
  EXPECT_EQ(diagnostics.all()[19].location.line, 20);
  EXPECT_EQ(diagnostics.all()[20].message, "and more errors in this file");
}

}  // namespace
}  // namespace norrsken
