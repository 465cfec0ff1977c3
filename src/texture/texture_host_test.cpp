#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <span>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

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
  const std::uint32_t texels = word_at(p, 8), table = word_at(p, 10);
  EXPECT_EQ(word_at(p, 9), 0u) << "packed";
  EXPECT_EQ(word_at(p, 11), 0u) << "repeat";
  EXPECT_EQ(word_at(p, 12), 0u) << "bilinear";
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
  EXPECT_EQ(word_at(p, 11), 2u);
  EXPECT_EQ(word_at(p, 12), 1u);
  EXPECT_FLOAT_EQ(c.tables().texels[word_at(p, 10) + 128], 128 / 255.0f);
  const Compiled mirrored = compile_texture(bitmap(kFile + R"(<string name="wrap_mode" value="mirror"/>)"));
  EXPECT_EQ(word_at(stored(mirrored, TextureKind::bitmap), 11), 1u);
}

TEST(BitmapHost, ReadsAFileOnceHoweverOftenItIsNamed) {
  const std::string other =
      R"(<shape type="rectangle"><bsdf type="diffuse">)" +
      bitmap(R"(<string name="filename" value="./a.bmp"/><string name="wrap_mode" value="clamp"/>)") +
      "</bsdf></shape>";
  EXPECT_EQ(compile_texture(bitmap(kFile), other).tables().texels.size(), 256u + 4);
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
                          "[accel, filename, filter_type, format, raw, to_uv, wrap_mode]"));
}

TEST(CheckerboardHost, StoresItsColours) {
  const Compiled c = compile_texture(R"(<texture name="reflectance" type="checkerboard">
    <rgb name="color0" value="0.1, 0.2, 0.3"/><spectrum name="color1" type="uniform"><float name="value" value="0.6"/></spectrum>
    <transform name="to_uv"><scale x="4" y="5"/></transform></texture>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  const auto p = stored(c, TextureKind::checkerboard);
  EXPECT_THAT(std::vector(p.begin(), p.begin() + 12),
              ElementsAre(4, 0, 0, 0, 5, 0, 0.1f, 0.2f, 0.3f, 0.6f, 0.6f, 0.6f));
  const Compiled plain = compile_texture(R"(<texture name="reflectance" type="checkerboard"/>)");
  const auto defaults = stored(plain, TextureKind::checkerboard);
  EXPECT_THAT(std::vector(defaults.begin(), defaults.begin() + 12),
              ElementsAre(1, 0, 0, 0, 1, 0, 0.4f, 0.4f, 0.4f, 0.2f, 0.2f, 0.2f));
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
  for (std::uint32_t k = 9; k < 12; ++k) EXPECT_FLOAT_EQ(parameters.at(texture + k), 0.4f);
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
  EXPECT_EQ(parameters.at(texture + 9), 0.1f);
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
              ElementsAre("error: unused texture 'checkerboard' in bsdf 'diffuse' [no children]"));
}

// By reference, and where nobody refers to it.
TEST(Textures, MayStandInTheScene) {
  const Compiled c = compile_elements(kSensor + kEmitter + R"(<texture type="checkerboard" id="t"/>
    <texture type="rawconstant" id="c"><float name="value" value="1"/></texture>
    <shape type="rectangle"><bsdf type="diffuse"><ref name="reflectance" id="t"/></bsdf></shape>
    <shape type="rectangle"><bsdf type="diffuse"><ref name="reflectance" id="t"/></bsdf></shape>)");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().parameters.size(), 2u * 12 + 2 * 4);
  EXPECT_THAT(
      compile_elements(kSensor + kShape + kEmitter + R"(<texture type="bitmap"/>)").messages(),
      ElementsAre("error: texture 'bitmap' needs a parameter 'filename' [<string name=\"filename\" value=\"...\"/>]"));
}

}  // namespace
}  // namespace norrsken::testing
