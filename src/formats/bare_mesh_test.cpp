// Mesh files as scenes, STL and MTL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/bare_mesh.h"
#include "formats/mesh_readers.h"
#include "formats/mtl.h"
#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kStl =
    "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "2\nendloop\nendfacet\nendsolid\n";

std::string scene_of(const std::string& path, const TestFiles& files) {
  Diagnostics diagnostics;
  const auto description = read_bare_mesh(path, MemoryFiles(files), diagnostics);
  return to_text(diagnostics) + (description ? text_of(*description->scene) : "none");
}

std::string binary_stl(std::uint32_t facets, std::size_t bytes) {
  std::string text = "solid, for all that" + std::string(61, ' ');
  for (int k = 0; k < 4; ++k) text += static_cast<char>(facets >> 8 * k & 0xffu);
  return text + std::string(bytes, '\0');
}

TEST(Stl, IsTextOrBinaryByItsLength) {
  Diagnostics diagnostics;
  const auto text = read_stl(kStl, "a.stl", diagnostics);
  ASSERT_TRUE(text);
  EXPECT_EQ(text->triangles.size(), 1u);
  EXPECT_EQ(text->positions[2][2], 2);
  EXPECT_TRUE(text->face_normals);
  const auto binary = read_stl(binary_stl(2, 100), "a.stl", diagnostics);
  ASSERT_TRUE(binary) << to_text(diagnostics);
  EXPECT_EQ(binary->triangles.size(), 2u);
}

TEST(Stl, ThatIsWrongIsAnError) {
  const auto complaint = [](const std::string& bytes) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_stl(bytes, "a.stl", diagnostics));
    return to_text(diagnostics);
  };
  EXPECT_THAT(complaint(binary_stl(0, 0)), HasSubstr("no facets"));
  EXPECT_THAT(complaint(std::string(80, 'x') + std::string("\5\0\0\0abc", 7)),
              HasSubstr("the file is cut off: 5 facets take 334 bytes, it has 87"));
  EXPECT_THAT(complaint("ply"), HasSubstr("the file is no STL"));
  EXPECT_THAT(complaint("solid\nfacet\nouter loop\nvertex 1 2 x\n"),
              HasSubstr("a.stl:4:12: error: 'x' is not a number"));
  EXPECT_THAT(complaint("solid\nfacet\nouter loop\nvertex 1 2 3\nendloop\nendfacet\n"),
              HasSubstr("a facet has 1 vertices"));
}

TEST(BareMesh, IsFramedLitAndOnAFloor) {
  const std::string text = scene_of("a.stl", {{"a.stl", kStl}});
  EXPECT_THAT(
      text, AllOf(HasSubstr("note: a mesh without camera and light"), HasSubstr("shape mesh"), HasSubstr("shape disk"),
                  HasSubstr("sensor perspective"), HasSubstr("emitter envmap"), HasSubstr("face_normals = true")));
}

TEST(BareMesh, HasTheMaterialsThatItNames) {
  const std::string obj =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 2 3\nusemtl lamp\nf 1 2 4\nusemtl red\nf 2 3 "
      "4\n";
  const std::string text = scene_of(
      "a.obj", {{"a.obj", obj}, {"a.mtl", "newmtl red\nKd 1 0 0\nd 0.5\nnewmtl lamp\nKd 0.5\nKe 3 3 3\nPr 0.25\n"}});
  EXPECT_THAT(text, AllOf(HasSubstr("base_color = rgb 1 0 0"), HasSubstr("opacity = 0.5"),
                          HasSubstr("base_color = rgb 0.5 0.5 0.5"), HasSubstr("radiance = rgb 3 3 3"),
                          HasSubstr("roughness = 0.25")));
  EXPECT_THAT(scene_of("a.obj", {{"a.obj", obj}}), HasSubstr("warning: cannot read the materials 'a.mtl'"));
}

TEST(BareMesh, IsFlatWhereAnObjHasNeitherNormalsNorSmoothing) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_THAT(scene_of("a.obj", {{"a.obj", triangle}}), HasSubstr("face_normals = true"));
  EXPECT_THAT(scene_of("a.obj", {{"a.obj", "s 1\n" + triangle}}), Not(HasSubstr("face_normals")));
  EXPECT_THAT(scene_of("a.obj", {{"a.obj", "s off\n" + triangle}}), HasSubstr("face_normals = true"));
}

TEST(Mtl, TellsOfWhatIsNoNumber) {
  Diagnostics diagnostics;
  read_mtl("newmtl a\nKd 1 red 0\n", "a.mtl", diagnostics);
  EXPECT_THAT(to_text(diagnostics), HasSubstr("a.mtl:2:6: error: 'red' is not a number"));
}

}  // namespace
}  // namespace norrsken
