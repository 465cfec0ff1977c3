// Files that are no scenes.
#include "formats/other_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

std::string message(const std::string& path, const std::string& bytes) {
  const auto other = recognise_other_file(path, bytes);
  return other ? other->message : "";
}

TEST(OtherFiles, AreKnownByTheirFirstBytes) {
  EXPECT_EQ(message("a", "\x76\x2f\x31\x01\x02\0\0\0"s), "'a' is an OpenEXR image, not a scene");
  EXPECT_EQ(message("dir/a.xml", "\x89PNG\r\n\x1a\n"), "'a.xml' is a PNG image, not a scene");
  EXPECT_EQ(message("a.jpg", "\xff\xd8\xff\xe0"), "'a.jpg' is a JPEG image, not a scene");
  EXPECT_EQ(message("a.hdr", "#?RADIANCE\n"), "'a.hdr' is a Radiance HDR image, not a scene");
  EXPECT_EQ(message("a.blend", "BLENDER-v300"), "'a.blend' is a Blender file, not a scene");
  EXPECT_EQ(message("a.blend", "BLENDER17-01v0500"), "'a.blend' is a Blender file, not a scene");
  EXPECT_EQ(message("a.xml.gz", "\x1f\x8b\x08"), "'a.xml.gz' is a packed file (gzip), not a scene");
  EXPECT_EQ(message("a.zip", "PK\x03\x04"), "'a.zip' is a packed file (ZIP), not a scene");
  EXPECT_EQ(message("a.glb", "glTF\x02"), "'a.glb' is a glTF scene, not a scene of Mitsuba's XML");
  EXPECT_EQ(message("a.usdc", "PXR-USDC"), "'a.usdc' is a USD scene, not a scene of Mitsuba's XML");
  EXPECT_EQ(message("a.usda", "#usda 1.0\n"), "'a.usda' is a USD scene, not a scene of Mitsuba's XML");
  EXPECT_EQ(message("a", "\x89Norrsk\n"), "'a' is a checkpoint of this program, not a scene");
}

TEST(OtherFiles, AreKnownByTheirText) {
  EXPECT_EQ(message("a.ply", "ply\nformat ascii 1.0\n"), "'a.ply' is a PLY mesh, not a scene");
  EXPECT_EQ(message("a.obj", "# Blender\no Cube\nv 1 2 3\n"), "'a.obj' is a Wavefront OBJ mesh, not a scene");
  EXPECT_EQ(message("a.txt", "\r\nv 1 2 3\r\nf 1 1 1\r\n"), "'a.txt' is a Wavefront OBJ mesh, not a scene");
  EXPECT_EQ(message("a.mtl", "# x\nnewmtl a\n"), "'a.mtl' is a material library of an OBJ mesh, not a scene");
  EXPECT_EQ(message("a.stl", "solid a\n"), "'a.stl' is an STL mesh, not a scene");
  EXPECT_EQ(message("a.gltf", R"({"asset": {"version": "2.0"}})"),
            "'a.gltf' is a glTF scene, not a scene of Mitsuba's XML");
  EXPECT_EQ(message("a.json", R"({"bsdfs": []})"), "'a.json' is JSON, not a scene");
  EXPECT_EQ(message("a.pbrt", "# x\nLookAt 1 2 3  0 0 0  0 1 0\n"),
            "'a.pbrt' is a pbrt scene, not a scene of Mitsuba's XML");
  EXPECT_EQ(message("a.pbrt", "WorldBegin\n"), "'a.pbrt' is a pbrt scene, not a scene of Mitsuba's XML");
  EXPECT_EQ(message("a.xml", "\n<!DOCTYPE html>\n<html>"), "'a.xml' is a page of HTML, not a scene");
  EXPECT_EQ(message("a.dae", "<?xml version=\"1.0\"?>\n<COLLADA>"),
            "'a.dae' is a COLLADA scene, not a scene of Mitsuba's XML");
  EXPECT_EQ(message("a.xml", "version https://git-lfs.github.com/spec/v1\n"),
            "'a.xml' is the address of a file in Git LFS, not a scene");
}

TEST(OtherFiles, WhatMayBeASceneIsLeftToTheReader) {
  for (const char* bytes : {"", " \n", "hello", "<scene/>", "<?xml version='1.0'?><scene/>", "\xEF\xBB\xBF<scene/>"})
    EXPECT_EQ(message("a.xml", bytes), "") << bytes;
  EXPECT_EQ(message("a.xml", "\xFF\xFE<\0s\0"s), "");
  EXPECT_EQ(message("a.xml", "<\0s\0"s), "");
}

TEST(OtherFiles, OfAMeshThereIsASceneThatShowsIt) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_scene("v 1 2 0\nv 5 2 0\nv 1 5 0\nf 1 2 3\n", {}, diagnostics));
  EXPECT_EQ(to_text(diagnostics), R"(room.xml: error: 'room.xml' is a Wavefront OBJ mesh, not a scene
accepted: a scene that has the mesh, such as this one beside it
    <scene version="3.0.0">
      <sensor type="perspective"><transform name="to_world"><lookat origin="3 2 4" target="0 0 0" up="0 1 0"/></transform></sensor>
      <emitter type="constant"/>
      <shape type="obj"><string name="filename" value="room.xml"/><transform name="to_world"><translate value="-3 -3.5 0"/><scale value="0.4"/></transform></shape>
    </scene>)");
  // What cannot be read has no bounds.
  EXPECT_THAT(recognise_other_file("a.obj", "v 1 2 3\nf 1 2 3\n")->accepted, HasSubstr("value=\"a.obj\"/></shape>"));
  EXPECT_THAT(recognise_other_file("a&\"<.ply", "ply\n")->accepted, HasSubstr("value=\"a&amp;&quot;&lt;.ply\""));
  EXPECT_EQ(complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0"><include filename="a.ply"/></scene>)"},
                                       {"a.ply", "ply\n"}})
                .substr(0, 72),
            "a.ply: error: 'a.ply' is a PLY mesh, not a scene (named at room.xml:1:43");
}

}  // namespace
}  // namespace norrsken
