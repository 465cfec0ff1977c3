#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "compile/compile_testing.h"
#include "texture/bitmap.h"

namespace norrsken::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// 2 x 2 BMP; colours from the top left: (3, 2, 1), (6, 5, 4), (9, 8, 7), (255, 0, 10).
std::string bmp() {
  std::string bytes = "BM";
  const auto add = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  };
  for (const std::uint32_t value : {70u, 0u, 54u, 40u, 2u, 2u}) add(value, 4);
  add(1, 2), add(24, 2);
  for (const std::uint32_t value : {0u, 16u, 2835u, 2835u, 0u, 0u}) add(value, 4);
  return bytes + std::string("\x07\x08\x09\x0a\x00\xff\0\0\x01\x02\x03\x04\x05\x06\0\0", 16);
}

/// 2 x 1 PFM of colours.
std::string pfm(const std::vector<float>& values) {
  return "PF\n2 1\n-1.0\n" + std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

Compiled compile_texture(const std::string& texture, const std::string& more = {}) {
  return compile_elements(
      kSensor + kEmitter + "<shape type=\"rectangle\"><bsdf type=\"diffuse\">" + texture + "</bsdf></shape>" + more,
      {{"a.bmp", bmp()}, {"broken.png", "no image"}});
}
std::string bitmap(const std::string& inside) {
  return "<texture name=\"reflectance\" type=\"bitmap\">" + inside + "</texture>";
}
const std::string kFile = R"(<string name="filename" value="a.bmp"/>)";

/// The parameters of the first shape's only texture.
std::span<const float> stored(const Compiled& c, TextureKind kind) {
  const SceneTables& t = c.tables();
  const std::uint32_t diffuse = t.surfaces.at(0).material_front & kMaterialOffsetMask;
  const auto word = std::bit_cast<TextureWord>(t.parameters.at(diffuse + 3));
  EXPECT_EQ(texture_kind(word), kind);
  EXPECT_EQ(t.texture_kinds, 1u << static_cast<std::uint32_t>(kind));
  EXPECT_TRUE(t.needs_uv);
  return std::span(t.parameters).subspan(word & kTextureOffsetMask);
}
std::uint32_t word_at(std::span<const float> values, std::size_t i) { return std::bit_cast<std::uint32_t>(values[i]); }

TEST(BitmapHost, StoresBytesAndATableThatDecodesThem) {
  const Compiled c = compile_texture(bitmap(kFile));
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto p = stored(c, TextureKind::bitmap);
  EXPECT_THAT(std::vector(p.begin(), p.begin() + 8), ElementsAre(1, 0, 0, 0, 1, 0, 2, 2));
  const std::uint32_t texels = word_at(p, 8), table = word_at(p, 9);
  EXPECT_EQ(word_at(p, 10), 0u) << "packed, repeated, bilinear, as uv are";
  const auto& t = c.tables().texels;
  ASSERT_EQ(t.size(), 256u + 4);
  EXPECT_EQ(word_at(t, texels), 3u | 2u << 8 | 1u << 16);
  EXPECT_EQ(word_at(t, texels + 3), 255u | 0u << 8 | 10u << 16);
  EXPECT_EQ(t[table + 255], 1.0f);
  EXPECT_NEAR(t[table + 128], 0.2158605, 1e-6);
  // A texture's own colour is its mean.
  const float red = c.tables().parameters.at(c.tables().surfaces.at(0).material_front & kMaterialOffsetMask);
  EXPECT_NEAR(red, (t[table + 3] + t[table + 6] + t[table + 9] + 1) / 4, 1e-6);
}

TEST(BitmapHost, TakesEveryParameter) {
  const Compiled c = compile_texture(bitmap(
      kFile +
      R"(<string name="filter_type" value="nearest"/><string name="wrap_mode" value="clamp"/>)"
      R"(<boolean name="raw" value="true"/><string name="format" value="fp16"/><boolean name="accel" value="false"/>)"
      R"(<transform name="to_uv"><scale x="2" y="3"/><translate x="0.25" y="0.5"/></transform>)"));
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto p = stored(c, TextureKind::bitmap);
  EXPECT_THAT(std::vector(p.begin(), p.begin() + 6), ElementsAre(2, 0, 0.25f, 0, 3, 0.5f));
  using isa_host::Bitmap;
  constexpr auto wraps = [](std::uint32_t u, std::uint32_t v) { return (u + 4 * v) << Bitmap::kWrapShift; };
  EXPECT_EQ(word_at(p, 10), wraps(2, 2) | Bitmap::kNearest | Bitmap::kMapped);
  EXPECT_FLOAT_EQ(c.tables().texels[word_at(p, 9) + 128], 128 / 255.0f);
  const Compiled mirrored = compile_texture(bitmap(kFile + R"(<string name="wrap_mode" value="mirror"/>)"));
  EXPECT_EQ(word_at(stored(mirrored, TextureKind::bitmap), 10), wraps(1, 1));
  const Compiled along_v = compile_texture(bitmap(kFile + R"(<string name="wrap_mode_v" value="clamp"/>)"));
  EXPECT_THAT(along_v.messages(), IsEmpty());
  EXPECT_EQ(word_at(stored(along_v, TextureKind::bitmap), 10), wraps(0, 2));
}

TEST(BitmapHost, ReadsAFileOnceHoweverOftenItIsNamed) {
  const std::string other =
      R"(<shape type="rectangle"><bsdf type="diffuse">)" +
      bitmap(R"(<string name="filename" value="./a.bmp"/><string name="wrap_mode" value="clamp"/>)") +
      "</bsdf></shape>";
  EXPECT_EQ(compile_texture(bitmap(kFile), other).tables().texels.size(), 256u + 4);
}

/// A diffuse shape and another one, whose reflectances are textures of these float files.
Compiled compile_floats(const std::vector<float>& values, const std::string& more = {}) {
  return compile_elements(kSensor + kEmitter + R"(<bsdf type="diffuse" id="b">
    <texture name="reflectance" type="bitmap"><string name="filename" value="a.pfm"/></texture></bsdf>
    <shape type="rectangle"><ref id="b"/></shape><shape type="sphere"><ref id="b"/></shape>)" +
                              more,
                          {{"a.pfm", pfm(values)}});
}

TEST(BitmapHost, TexelsOutOfRangeAreClampedWithOneWarning) {
  const Compiled c = compile_floats({-0.25f, 0.5f, 1, 0.5f, 1.5f, 0.25f});
  EXPECT_THAT(c.messages(), ElementsAre("warning: 'reflectance' has values from -0.25 to 1.5: those below 0 are taken "
                                        "for 0, those above 1 for 1"));
  const auto p = stored(c, TextureKind::bitmap);
  const auto& t = c.tables().texels;
  const std::uint32_t first = word_at(p, 8);
  EXPECT_THAT(std::vector(t.begin() + first, t.begin() + first + 6), ElementsAre(0, 0.5f, 1, 0.5f, 1, 0.25f));
  const float* mean = &c.tables().parameters.at(c.tables().surfaces.at(0).material_front & kMaterialOffsetMask);
  EXPECT_THAT(std::vector(mean, mean + 3), ElementsAre(0.25f, 0.75f, 0.625f)) << "that of what is drawn";
  EXPECT_THAT(compile_floats({0, 0, -1e-5f, 0, 0, 0}).messages(),
              ElementsAre("warning: 'reflectance' has values from -1e-05 to 0: those below 0 are taken for 0"));
  EXPECT_THAT(compile_floats({0, 0, 5, 0, 0, 0}).messages(),
              ElementsAre("warning: 'reflectance' has values from 0 to 5: those above 1 are taken for 1"));
  EXPECT_THAT(compile_floats({0, 0, 1, 0, 0, 0}).messages(), IsEmpty());
}

TEST(BitmapHost, WhatUsesOtherRangesSeesTheFilesOwnTexels) {
  const Compiled c =
      compile_floats({0, 0, 5, 0, 0, 0},
                     R"(<shape type="rectangle"><emitter type="area"><texture name="radiance" type="bitmap">
      <string name="filename" value="a.pfm"/></texture></emitter></shape>)");
  EXPECT_EQ(c.messages().size(), 1u);
  const auto& t = c.tables();
  EXPECT_EQ(t.texels.at(word_at(stored(c, TextureKind::bitmap), 8) + 2), 1);
  EXPECT_EQ(*std::ranges::max_element(t.texels), 5);
}

TEST(BitmapHost, SlidesOfLightsAreClampedToo) {
  for (const char* light : {R"(<emitter type="projector"><texture name="irradiance" type="bitmap">)",
                            R"(<emitter type="spot"><texture name="texture" type="bitmap">)"}) {
    const Compiled c =
        compile_elements(kSensor + kShape + light + R"(<string name="filename" value="a.pfm"/></texture></emitter>)",
                         {{"a.pfm", pfm({-1, 2, 3, 4, 5, 6})}});
    ASSERT_EQ(c.messages().size(), 1u);
    EXPECT_THAT(c.messages()[0], ::testing::EndsWith("has values from -1 to 6: those below 0 are taken for 0"));
    EXPECT_EQ(c.tables().texels.at(6), 0) << "a copy";
  }
}

TEST(BitmapHost, TexelsThatAreNotFiniteAreReplaced) {
  const float inf = std::numeric_limits<float>::infinity();
  const Compiled c =
      compile_elements(kSensor + R"(<shape type="rectangle"><emitter type="area"><texture name="radiance" type="bitmap">
      <string name="filename" value="a.pfm"/></texture></emitter></shape>)",
                       {{"a.pfm", pfm({inf, 1, std::nanf(""), 2, 3, 4})}});
  EXPECT_THAT(c.messages(),
              ElementsAre("warning: the image 'a.pfm' has 2 values that are not finite: infinite ones are "
                          "taken for 65504, others for 0"));
  EXPECT_THAT(c.tables().texels, ElementsAre(65504, 1, 0, 2, 3, 4));
}

TEST(Textures, OnMeshesWithoutTextureCoordinatesAreWarnedOf) {
  const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto messages = [&](const std::string& inside, const std::string& obj) {
    return compile_elements(kSensor + kEmitter + R"(<shape type="obj"><string name="filename" value="a.obj"/>)" +
                                inside + "</shape>",
                            {{"a.obj", obj}, {"a.bmp", bmp()}})
        .messages();
  };
  const auto warns = [](const std::string& plugin) {
    return ElementsAre(::testing::MatchesRegex("warning: shape 'obj' has no texture coordinates: texture '" + plugin +
                                               "' \\(scene.xml:[0-9]+:[0-9]+\\) is drawn anew on every triangle"));
  };
  const std::string diffuse = R"(<bsdf type="diffuse">)" + bitmap(kFile) + "</bsdf>";
  EXPECT_THAT(messages(diffuse, plain), warns("bitmap"));
  EXPECT_THAT(messages(R"(<bsdf type="twosided">)" + diffuse + "</bsdf>", plain), warns("bitmap"));
  EXPECT_THAT(
      messages(R"(<bsdf type="bumpmap"><texture type="bitmap">)" + kFile + R"(</texture><bsdf type="diffuse"/></bsdf>)",
               plain),
      warns("bitmap"));
  EXPECT_THAT(messages(R"(<emitter type="area"><texture name="radiance" type="checkerboard"/></emitter>)", plain),
              warns("checkerboard"));
  EXPECT_THAT(messages(diffuse, "vt 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n"), IsEmpty());
  EXPECT_THAT(messages(R"(<bsdf type="diffuse"><texture name="reflectance" type="uniform">
                       <float name="value" value="0.5"/></texture></bsdf>)",
                       plain),
              IsEmpty())
      << "the same everywhere";
  EXPECT_THAT(messages(R"(<bsdf type="diffuse"/>)", plain), IsEmpty());
}

TEST(BitmapHost, RefusesWhatItCannotRead) {
  EXPECT_THAT(
      compile_texture(bitmap("")).messages(),
      ElementsAre("error: texture 'bitmap' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
  EXPECT_THAT(compile_texture(bitmap(R"(<string name="filename" value="none.png"/>)")).messages(),
              ElementsAre("error: there is no file 'none.png' [a file in the current folder]"));
  EXPECT_THAT(compile_texture(bitmap(R"(<string name="filename" value="broken.png"/>)")).messages(),
              ElementsAre("error: cannot read the image 'broken.png': unknown or damaged image file "
                          "[a PNG, JPEG, BMP, TGA, TIFF, PNM, PFM, EXR or HDR file]"));
  EXPECT_THAT(compile_texture(bitmap(kFile + R"(<string name="wrap_mode" value="miror"/>)")).messages(),
              ElementsAre("error: 'wrap_mode' is 'miror', did you mean 'mirror'? [repeat, mirror, clamp]"));
  EXPECT_THAT(compile_texture(bitmap(kFile + R"(<string name="filter_type" value="cubic"/>)")).messages(),
              ElementsAre("error: 'filter_type' is 'cubic' [bilinear, nearest]"));
  EXPECT_THAT(compile_texture(bitmap(kFile + R"(<integer name="raw" value="1"/>)")).messages(),
              ElementsAre("error: 'raw' is an integer [boolean]"));
  EXPECT_THAT(compile_texture(bitmap(kFile + R"(<float name="gamma" value="1"/>)")).messages(),
              ElementsAre("error: unused parameter 'gamma' of texture 'bitmap' "
                          "[accel, filename, filter_type, format, raw, to_uv, wrap_mode, wrap_mode_u, wrap_mode_v]"));
}

TEST(CheckerboardHost, StoresItsColours) {
  const Compiled c = compile_texture(R"(<texture name="reflectance" type="checkerboard">
    <rgb name="color0" value="0.1, 0.2, 0.3"/><spectrum name="color1" type="uniform"><float name="value" value="0.6"/></spectrum>
    <transform name="to_uv"><scale x="4" y="5"/></transform></texture>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto p = stored(c, TextureKind::checkerboard);
  EXPECT_THAT(std::vector(p.begin(), p.begin() + 14),
              ElementsAre(4, 0, 0, 0, 5, 0, 0.1f, 0.2f, 0.3f, 0, 0.6f, 0.6f, 0.6f, 0));
  const Compiled plain = compile_texture(R"(<texture name="reflectance" type="checkerboard"/>)");
  const auto defaults = stored(plain, TextureKind::checkerboard);
  EXPECT_THAT(std::vector(defaults.begin(), defaults.begin() + 14),
              ElementsAre(1, 0, 0, 0, 1, 0, 0.4f, 0.4f, 0.4f, 0, 0.2f, 0.2f, 0.2f, 0));
}

TEST(CheckerboardHost, MayHaveTexturesInPlaceOfColours) {
  const Compiled c = compile_texture(R"(<texture name="reflectance" type="checkerboard">
    <texture name="color0" type="bitmap">)" +
                                     kFile + R"(</texture>
    <texture name="color1" type="checkerboard"><float name="color0" value="0.9"/></texture></texture>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const SceneTables& t = c.tables();
  const std::uint32_t diffuse = t.surfaces.at(0).material_front & kMaterialOffsetMask;
  const auto outer = word_at(t.parameters, diffuse + 3) & kTextureOffsetMask;
  EXPECT_EQ(texture_kind(word_at(t.parameters, outer + 9)), TextureKind::bitmap);
  const TextureWord inner = word_at(t.parameters, outer + 13);
  EXPECT_EQ(texture_kind(inner), TextureKind::checkerboard);
  EXPECT_EQ(t.parameters.at((inner & kTextureOffsetMask) + 6), 0.9f);
}

TEST(CheckerboardHost, TexturesInsideAreHeldToWhatTheyCanBe) {
  EXPECT_THAT(
      compile_texture(R"(<texture name="reflectance" type="checkerboard">
                <texture name="color0" type="mesh_attribute"><string name="name" value="vertex_color"/></texture></texture>)")
          .messages(),
      Contains("error: 'color0' is a mesh_attribute [a value, or a texture that looks at texture coordinates]"));
  std::string nested = R"(<float name="color0" value="0.1"/>)";
  for (int i = 0; i < 8; ++i) nested = R"(<texture name="color0" type="checkerboard">)" + nested + "</texture>";
  EXPECT_THAT(compile_texture(R"(<texture name="reflectance" type="checkerboard">)" + nested + "</texture>").messages(),
              ElementsAre("error: textures are nested more than 8 deep [up to 8 inside each other]"));
}

TEST(Daylight, IsTheTextureInside) {
  const auto messages = [](const std::string& inside) {
    const Compiled c = compile_texture(R"(<spectrum name="reflectance" type="d65">)" + inside + "</spectrum>");
    stored(c, TextureKind::bitmap);
    return c.messages();
  };
  const std::string image = R"(<texture type="bitmap">)" + kFile + "</texture>";
  EXPECT_THAT(messages(image), IsEmpty());
  EXPECT_THAT(messages(image + R"(<float name="scale" value="3"/>)"),
              ElementsAre("note: 'scale' of a d65 with a spectrum or texture inside has no effect, as in Mitsuba's RGB "
                          "variants [a scale of the emitter, or of the values inside]"));
  const Compiled plain = compile_texture(
      R"(<spectrum name="reflectance" type="d65"><spectrum type="uniform"><float name="value" value="0.7"/></spectrum></spectrum>)");
  EXPECT_THAT(plain.messages(), IsEmpty());
  EXPECT_EQ(plain.tables().parameters.at(plain.tables().surfaces.at(0).material_front & kMaterialOffsetMask), 0.7f);
}

TEST(CheckerboardHost, OfColoursIsTheirMeanWhereItStandsForANumber) {
  const Compiled c = compile_bsdf(
      R"(<bsdf type="mask"><texture name="opacity" type="checkerboard"><rgb name="color0" value="0.1 0.2 0.9"/>
      <float name="color1" value="0.3"/></texture><bsdf type="diffuse"/></bsdf>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto& parameters = c.tables().parameters;
  const std::uint32_t mask = c.tables().surfaces.at(0).material_front & kMaterialOffsetMask;
  const std::uint32_t texture = word_at(parameters, mask + 1) & kTextureOffsetMask;
  EXPECT_FLOAT_EQ(parameters.at(texture + 6), 0.3f);
  for (std::uint32_t k = 10; k < 13; ++k) EXPECT_FLOAT_EQ(parameters.at(texture + k), 0.4f);
}

TEST(CheckerboardHost, ChangesItsColoursForNumbersAsMitsubaDoes) {
  const Compiled c = compile_bsdf(
      R"(<bsdf type="mask"><texture name="opacity" type="checkerboard"><float name="color0" value="0.1"/>
      <float name="color1" value="0.9"/></texture><bsdf type="diffuse"/></bsdf>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto& parameters = c.tables().parameters;
  const std::uint32_t mask = c.tables().surfaces.at(0).material_front & kMaterialOffsetMask;
  const std::uint32_t texture = word_at(parameters, mask + 1) & kTextureOffsetMask;
  EXPECT_EQ(parameters.at(texture + 6), 0.9f);
  EXPECT_EQ(parameters.at(texture + 10), 0.1f);
}

TEST(CheckerboardHost, IsHeldAgainstTheParametersRange) {
  EXPECT_THAT(
      compile_texture(R"(<texture name="reflectance" type="checkerboard"><float name="color1" value="1.5"/></texture>)")
          .messages(),
      ElementsAre("error: 'reflectance' has values from 0.4 to 1.5 [a texture with values from 0 to 1]"));
  EXPECT_THAT(compile_texture(
                  R"(<texture name="reflectance" type="checkerboard"><string name="color0" value="red"/></texture>)")
                  .messages(),
              ElementsAre("error: 'color0' is a string [rgb, spectrum, float]"));
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "property float r\nproperty float g\nproperty float b\nelement face 1\nproperty list uchar int vertex_indices\n"
    "end_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2\n";

Compiled compile_attribute(const std::string& inside, const std::string& more = {}) {
  return compile_elements(
      kSensor + kEmitter + R"(<bsdf type="diffuse" id="b"><texture name="reflectance" type="mesh_attribute">)" +
          inside +
          R"(</texture></bsdf><shape type="ply"><string name="filename" value="a.ply"/><ref id="b"/></shape>)" + more,
      {{"a.ply", kPly}});
}

TEST(MeshAttributeHost, LeadsFromShapesToValues) {
  const Compiled c =
      compile_attribute(R"(<string name="name" value="vertex_color"/><float name="scale" value="0.5"/>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto p = stored(c, TextureKind::mesh_attribute);
  EXPECT_EQ(p[0], 0.5f);
  const auto& t = c.tables().texels;
  const std::uint32_t table = word_at(p, 1), values = word_at(t, table);
  EXPECT_EQ(word_at(t, table + 1), 3u);
  EXPECT_THAT(std::vector(t.begin() + values, t.begin() + values + 9), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
}

TEST(MeshAttributeHost, RefusesNamesThatAShapeHasNot) {
  EXPECT_THAT(
      compile_attribute(R"(<string name="name" value="vertex_colour"/>)").messages(),
      ElementsAre("error: shape 'ply' has no attribute 'vertex_colour', did you mean 'vertex_color'? [vertex_color]"));
  EXPECT_THAT(compile_attribute(R"(<string name="name" value="vertex_color"/>)",
                                R"(<shape type="sphere"><ref id="b"/></shape>)")
                  .messages(),
              ElementsAre("error: shape 'sphere' has no attribute 'vertex_color' [a mesh with attributes]"));
  EXPECT_THAT(compile_attribute(R"(<string name="name" value="color"/>)").messages(),
              ::testing::Contains("error: 'color' is not the name of a mesh's attribute [vertex_... or face_...]"));
  EXPECT_THAT(compile_attribute("").messages(),
              ElementsAre("error: texture 'mesh_attribute' needs a parameter 'name' [<string name=\"name\" "
                          "value=\"vertex_color\"/>]"));
}

TEST(Textures, UnknownAndMisplacedOnesAreRefused) {
  EXPECT_THAT(
      compile_texture(R"(<texture name="reflectance" type="bitmpa"/>)").messages(),
      ElementsAre("error: unknown texture 'bitmpa', did you mean 'bitmap'? [bitmap, checkerboard, mesh_attribute]"));
  EXPECT_THAT(compile_texture(R"(<texture name="reflectance" type="volume"/>)").messages(),
              ElementsAre("error: texture 'volume' is not supported yet [bitmap, checkerboard, mesh_attribute]"));
  EXPECT_THAT(compile_texture(R"(<texture name="reflectence" type="checkerboard"/>)").messages(),
              ElementsAre("error: unused texture 'checkerboard' named 'reflectence' in bsdf 'diffuse', did you mean "
                          "'reflectance'? [the names reflectance]"));
}

// By reference, and where nobody refers to it.
TEST(Textures, MayStandInTheScene) {
  const Compiled c = compile_elements(kSensor + kEmitter + R"(<texture type="checkerboard" id="t"/>
    <texture type="rawconstant" id="c"><float name="value" value="1"/></texture>
    <shape type="rectangle"><bsdf type="diffuse"><ref name="reflectance" id="t"/></bsdf></shape>
    <shape type="rectangle"><bsdf type="diffuse"><ref name="reflectance" id="t"/></bsdf></shape>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().parameters.size(), 2u * 14 + 2 * 4);
  EXPECT_THAT(
      compile_elements(kSensor + kShape + kEmitter + R"(<texture type="bitmap"/>)").messages(),
      ElementsAre("error: texture 'bitmap' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
}

}  // namespace
}  // namespace norrsken::testing
