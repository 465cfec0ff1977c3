// Files that are no scenes.
#include "formats/other_files.h"

#include <fmt/format.h>
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

TEST(OtherFiles, ScenesOfOtherPrograms) {
  const auto scene = [](const char* name, const char* what) {
    return fmt::format("'{}' is {} scene, not a scene of Mitsuba's XML", name, what);
  };
  for (const char* part : {"AttributeBegin\n", "Shape \"sphere\" \"float radius\" 1\n", "Include \"a.pbrt\"\n",
                           "MakeNamedMaterial \"m\"\n", "Translate -1 0 .5\n"})
    EXPECT_EQ(message("a.txt", part), scene("a.txt", "a pbrt")) << part;
  EXPECT_EQ(message("a.pbrt", "# nothing\n"), scene("a.pbrt", "a pbrt"));
  EXPECT_EQ(message("a.fbx", "Kaydara FBX Binary  \0"s), scene("a.fbx", "an FBX"));
  EXPECT_EQ(message("a.fbx", "; FBX 7.3.0 project file\n"), scene("a.fbx", "an FBX"));
  EXPECT_EQ(message("a.usdz", "PK\x03\x04"), scene("a.usdz", "a USD"));
  EXPECT_EQ(message("a.x3d", "<?xml version=\"1.0\"?>\n<X3D>"), scene("a.x3d", "an X3D"));
}

TEST(OtherFiles, Meshes) {
  EXPECT_EQ(message("a.obj", "#" + std::string(100000, 'x') + "\n" + std::string(1000, '#') + "\nv 1 2 3\n"),
            "'a.obj' is a Wavefront OBJ mesh, not a scene");
  std::string comments;
  for (int i = 0; i < 5000; ++i) comments += "# a long licence\n\n";
  EXPECT_EQ(message("a.obj", comments + "v 1 2 3\n"), "'a.obj' is a Wavefront OBJ mesh, not a scene");
  EXPECT_EQ(message("a.off", "OFF\n3 1 0\n"), "'a.off' is an OFF mesh, not a scene");
  EXPECT_EQ(message("a", "# x\nCOFF\n3 1 0\n"), "'a' is an OFF mesh, not a scene");
  EXPECT_EQ(message("a", std::string(80, '\0') + "\x01\0\0\0"s + std::string(50, '\0')),
            "'a' is an STL mesh, not a scene");
}

TEST(OtherFiles, NoScenesAtAll) {
  EXPECT_EQ(message("a.xml", ""), "'a.xml' is empty, not a scene");
  EXPECT_EQ(message("a.xml", "\xEF\xBB\xBF \n"), "'a.xml' is empty, not a scene");
  EXPECT_EQ(message("a.xml", "404: Not Found"), "'a.xml' is plain text, not a scene");
  EXPECT_EQ(message("a.xml", "Shape of things\nto come"), "'a.xml' is plain text, not a scene");
  EXPECT_EQ(message("a.xml", "<?xml version=\"1.0\"?>\n<!-- x -->\n<HTML><body>404"),
            "'a.xml' is a page of HTML, not a scene");
  EXPECT_EQ(message("a.py", "import mitsuba as mi\n"), "'a.py' is a program in Python, not a scene");
  EXPECT_EQ(message("a.gif", "GIF89a"), "'a.gif' is a GIF image, not a scene");
  EXPECT_EQ(message("a.webp", "RIFF\x10\0\0\0WEBPVP8 "s), "'a.webp' is a WebP image, not a scene");
  EXPECT_EQ(message("a", "\x01\x02\0\0xyz"s), "'a' is a file of binary data, not a scene");
}

TEST(OtherFiles, WhatMayBeASceneIsLeftToTheReader) {
  for (const char* bytes :
       {"<scene/>", "x <scene/>", "<!-- <html> --><scene/>", "<?xml version='1.0'?><scene/>", "\xEF\xBB\xBF<scene/>"})
    EXPECT_EQ(message("a.xml", bytes), "") << bytes;
  EXPECT_EQ(message("a.xml", "\xFF\xFE<\0s\0"s), "");
  EXPECT_EQ(message("a.xml", "<\0s\0"s), "");
  EXPECT_EQ(message("a.xml", "\0\0\0<"s), "");
  EXPECT_EQ(message("a.xml", "\xFF\xFE\0\0<\0\0\0"s), "");
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
