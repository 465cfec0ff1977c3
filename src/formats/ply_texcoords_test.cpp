// Texture coordinates that a PLY file has in its faces.
#include <gtest/gtest.h>

#include <algorithm>

#include "formats/mesh_readers.h"
#include "formats/mesh_testing.h"
#include "formats/reader_testing.h"

namespace norrsken {
namespace {

/// A mesh that is read, and the warnings that come with it.
std::pair<MeshData, std::string> read_with_warnings(const std::string& bytes) {
  Diagnostics diagnostics;
  auto mesh = read_ply(bytes, "a.ply", diagnostics);
  EXPECT_TRUE(mesh.has_value() && !diagnostics.has_errors());
  return {mesh.value_or(MeshData{}), to_text(diagnostics)};
}

/// Vertices with a normal and a weight, and faces with texture coordinates for each corner, as MeshLab writes them.
std::string with_corner_texcoords(const std::string& vertices, const std::string& faces, int face_count) {
  const auto lines = std::to_string(std::ranges::count(vertices, '\n'));
  return "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex " + lines +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float w_0\nelement face " +
         std::to_string(face_count) +
         "\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n"
         "property float id_0\nend_header\n" +
         vertices + faces;
}

TEST(PlyTexcoords, TextureCoordinatesOfCornersSplitVertices) {
  const auto [mesh, warnings] = read_with_warnings(
      with_corner_texcoords("0 0 0 10\n1 0 0 11\n1 1 0 12\n0 1 0 13\n",
                            "3 0 1 2 6 0 0 1 0 1 1 0 7\n3 0 2 3 6 0 0 0.5 0.5 0 1 0 8\n3 1 2 3 0 0 9\n", 3));
  EXPECT_EQ(warnings, "a.ply: warning: 1 of 3 faces have no texture coordinates: they get (0, 0)");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  ASSERT_EQ(mesh.positions.size(), 8u) << "vertex 0 once, 1 twice, 2 three times, 3 twice";
  ASSERT_EQ(mesh.texcoords.size(), 8u);
  EXPECT_EQ(mesh.triangles[0][0], mesh.triangles[1][0]);
  EXPECT_EQ(mesh.texcoords[mesh.triangles[0][2]], (std::array<float, 2>{1, 1}));
  EXPECT_EQ(mesh.texcoords[mesh.triangles[1][1]], (std::array<float, 2>{0.5f, 0.5f}));
  EXPECT_EQ(mesh.texcoords[mesh.triangles[2][1]], (std::array<float, 2>{0, 0})) << "a face without any";
  for (const auto& t : {mesh.triangles[0][2], mesh.triangles[1][1], mesh.triangles[2][1]}) {
    EXPECT_EQ(mesh.positions[t], (std::array<float, 3>{1, 1, 0}));
    EXPECT_EQ(mesh.attributes.at(0).values.at(t), 12);
  }
  EXPECT_EQ(mesh.attributes.at(1).values, (Array<float>{7, 8, 9}));
}

TEST(PlyTexcoords, CornersOfConcavePolygonsKeepTheirTextureCoordinates) {
  std::string vertices = "0 0 0\n3 0 0\n3 1 0\n1 1 0\n1 3 0\n0 3 0\n";
  for (std::size_t i = 0; (i = vertices.find('\n', i)) != std::string::npos; i += 3) vertices.insert(i, " 1");
  // Twice the position.
  const auto [mesh, warnings] =
      read_with_warnings(with_corner_texcoords(vertices, "6 1 2 3 4 5 0 12 6 0 6 2 2 2 2 6 0 6 0 0 0 5\n", 1));
  EXPECT_EQ(warnings, "");
  EXPECT_EQ(area2(mesh), 10);
  ASSERT_EQ(mesh.positions.size(), 6u);
  for (std::size_t v = 0; v < 6; ++v)
    EXPECT_EQ(mesh.texcoords.at(v), (std::array<float, 2>{2 * mesh.positions[v][0], 2 * mesh.positions[v][1]}));
}

TEST(PlyTexcoords, EmptyListsEverywhereAreNone) {
  const auto [mesh, warnings] = read_with_warnings(
      with_corner_texcoords("0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n", "3 0 1 2 0 0 0\n3 0 2 3 0 0 0\n", 2));
  EXPECT_EQ(warnings, "");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.texcoords.size(), 0u);
}

TEST(PlyTexcoords, WrongNumbersOfTextureCoordinatesAreRefused) {
  Diagnostics diagnostics;
  const std::string bytes = with_corner_texcoords("0 0 0 1\n1 0 0 1\n1 1 0 1\n", "3 0 1 2 4 0 0 1 0 0 0\n", 1);
  EXPECT_FALSE(read_ply(bytes, "a.ply", diagnostics).has_value());
  EXPECT_EQ(to_text(diagnostics),
            "a.ply:18:21: error: face 0 has 4 texture coordinates for 3 vertices\n   18 | 3 0 1 2 4 0 0 1 0 0 0\n"
            "      |                     ^\naccepted: two for each, or none");
}

}  // namespace
}  // namespace norrsken
