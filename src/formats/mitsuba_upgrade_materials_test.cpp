// The upgrade of old scenes: BSDFs and textures.
#include "formats/mitsuba_upgrade_testing.h"

namespace norrsken {
namespace {

TEST(MitsubaUpgrade, TextureCoordinates) {
  expect_same(
      "0.6.0",
      R"(<texture type="checkerboard"><float name="uscale" value="4"/><float name="vscale" value="2"/></texture>)",
      R"(<texture type="checkerboard"><transform name="to_uv"><scale x="4" y="2"/></transform></texture>)");
  expect_same("0.6.0", R"(<texture type="checkerboard"><float name="uoffset" value="0.5"/></texture>)",
              R"(<texture type="checkerboard"><transform name="to_uv"><translate x="0.5"/></transform></texture>)");
  // As Mitsuba 3 upgrades it.
  expect_same_but(
      "0.6.0",
      R"(<texture type="checkerboard"><float name="uoffset" value="0.5"/><float name="uscale" value="3"/></texture>)",
      R"(<texture type="checkerboard"><transform name="to_uv"><translate x="0.5"/><scale x="3"/></transform></texture>)",
      "texture coordinates are moved before they are scaled");
}

TEST(MitsubaUpgrade, Bitmaps) {
  expect_same(
      "0.6.0",
      R"(<texture type="bitmap"><string name="wrapModeU" value="clamp"/><string name="wrapModeV" value="clamp"/>
                            <string name="filterType" value="ewa"/><float name="gamma" value="1"/>
                            <float name="maxAnisotropy" value="20"/><boolean name="cache" value="false"/></texture>)",
      R"(<texture type="bitmap"><string name="wrap_mode" value="clamp"/><string name="filter_type" value="bilinear"/>
                   <boolean name="raw" value="true"/></texture>)");
  expect_same("0.6.0", R"(<texture type="bitmap"><float name="gamma" value="-1"/></texture>)",
              R"(<texture type="bitmap"/>)");
  expect_same_but("0.6.0", R"(<texture type="bitmap"><float name="gamma" value="2.2"/></texture>)",
                  R"(<texture type="bitmap"/>)", "'gamma' of 2.2 is the curve of sRGB");
  EXPECT_THAT(read("0.6.0", R"(<texture type="bitmap"><float name="gamma" value="1.8"/></texture>)").description,
              HasSubstr("gamma = 1.8"));
}

TEST(MitsubaUpgrade, BitmapsThatWrapInOneDirection) {
  for (const char* mode : {"clamp", "repeat"}) {
    expect_same("0.6.0", fmt::format(R"(<texture type="bitmap"><string name="wrapModeU" value="{}"/></texture>)", mode),
                fmt::format(R"(<texture type="bitmap"><string name="wrap_mode_u" value="{}"/></texture>)", mode));
  }
  // What both have of their own hides what they might have in common.
  expect_same("0.6.0", R"(<texture type="bitmap"><string name="wrapMode" value="mirror"/>
                          <string name="wrapModeU" value="clamp"/><string name="wrapModeV" value="clamp"/></texture>)",
              R"(<texture type="bitmap"><string name="wrap_mode" value="clamp"/></texture>)");
}

TEST(MitsubaUpgrade, TexturesThatScale) {
  const std::string bitmap = R"(<texture type="bitmap"><string name="filename" value="a.png"/></texture>)";
  expect_same(
      "0.6.0",
      R"(<bsdf type="bumpmap"><texture type="scale"><float name="scale" value="10"/>)" + bitmap + "</texture></bsdf>",
      R"(<bsdf type="bumpmap"><float name="scale" value="10"/>)" + bitmap + "</bsdf>");
  expect_same(
      "0.6.0", R"(<bsdf type="diffuse"><texture type="scale" name="reflectance"><float name="scale" value="0.5"/>
                            <rgb name="value" value="0.2, 0.4, 0.6"/></texture></bsdf>)",
      R"(<bsdf type="diffuse"><texture type="rawconstant" name="reflectance"><rgb name="value" value="0.1 0.2 0.3"/></texture></bsdf>)");
  expect_same("0.6.0", R"(<texture type="scale">)" + bitmap + "</texture>", bitmap);
  EXPECT_THAT(
      read("0.6.0", R"(<texture type="scale"><float name="scale" value="2"/>)" + bitmap + "</texture>").description,
      HasSubstr("texture scale"));
  // By reference: the bump map has all of it, and nothing is left in the scene.
  expect_same("0.6.0",
              R"(<texture type="scale" id="s"><float name="scale" value="10"/>)" + bitmap +
                  R"(</texture><bsdf type="bumpmap"><ref id="s"/></bsdf>)",
              R"(<bsdf type="bumpmap"><float name="scale" value="10"/>)" + bitmap + "</bsdf>");
  expect_same(
      "0.6.0", R"(<texture type="scale"><float name="scale" value="0.5"/><texture type="checkerboard">
                          <rgb name="color0" value="0.2 0.4 0.6"/></texture></texture>)",
      R"(<texture type="checkerboard"><rgb name="color0" value="0.1 0.2 0.3"/><float name="color1" value="0.1"/></texture>)");
}

TEST(MitsubaUpgrade, NormalMapsAndVertexColours) {
  expect_same("0.6.0", R"(<bsdf type="normalmap"><texture type="bitmap"/><bsdf type="diffuse"/></bsdf>)",
              R"(<bsdf type="normalmap"><texture type="bitmap" name="normalmap"/><bsdf type="diffuse"/></bsdf>)");
  expect_same_but("0.6.0", R"(<texture type="vertexcolors"/>)",
                  R"(<texture type="mesh_attribute"><string name="name" value="vertex_color"/></texture>)",
                  "texture 'vertexcolors' is the 'mesh_attribute' vertex_color, of linear values");
}

TEST(MitsubaUpgrade, ConductorsAreOfCopperUnlessTheySayOtherwise) {
  for (const std::string plugin : {"conductor", "roughconductor"}) {
    const auto bsdf = [&plugin](const std::string& inside) {
      return "<bsdf type=\"" + plugin + "\">" + inside + "</bsdf>";
    };
    expect_same_but("0.6.0", bsdf(""), bsdf(R"(<string name="material" value="Cu"/>)"),
                    fmt::format("a '{}' without a material is of copper", plugin));
    const std::string none = R"(<string name="material" value="none"/>)";
    expect_same("0.6.0", bsdf(none + R"(<string name="extEta" value="air"/>)"), bsdf(none));
    const std::string numbers = R"(<rgb name="eta" value="1"/><rgb name="k" value="2"/>)";
    expect_same("0.6.0", bsdf(numbers + R"(<float name="extEta" value="1.000277"/>)"), bsdf(numbers));
    EXPECT_THAT(read("0.6.0", bsdf(R"(<rgb name="eta" value="1"/>)")).complaints,
                HasSubstr("error: '" + plugin + "' has 'eta' alone, and copper's 'k' in Mitsuba 0.6"));
  }
}

TEST(MitsubaUpgrade, MixturesAreBlends) {
  const std::string red = R"(<bsdf type="diffuse"><rgb name="reflectance" value="1 0 0"/></bsdf>)",
                    black = R"(<bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf>)";
  const auto mixture = [](const std::string& weights, const std::string& inside) {
    return R"(<bsdf type="mixturebsdf"><string name="weights" value=")" + weights + "\"/>" + inside + "</bsdf>";
  };
  const auto blend = [](const std::string& weight, const std::string& inside) {
    return R"(<bsdf type="blendbsdf"><float name="weight" value=")" + weight + "\"/>" + inside + "</bsdf>";
  };
  const std::string glass = R"(<bsdf type="dielectric"/>)", null = R"(<bsdf type="null"/>)";
  expect_same("0.6.0", mixture("0.7, 0.3", red + glass), blend("0.3", red + glass));
  expect_same("0.6.0", mixture("1 3", red + glass), blend("0.75", red + glass));  // scaled down to a sum of 1
  // What the weights leave is absorbed.
  expect_same("0.6.0", mixture("0.25, 0.25", red + glass), blend("0.75", red + blend("0.666666666666", glass + black)));
  expect_same("0.6.0", mixture("0.5, 0.25, 0.25", red + glass + null), blend("0.5", red + blend("0.5", glass + null)));
  // References are known when the blend is made.
  expect_same("0.6.0", R"(<bsdf type="null" id="a"/>)" + mixture("0.5 0.5", red + R"(<ref id="a"/>)"),
              R"(<bsdf type="null" id="a"/>)" + blend("0.5", red + R"(<ref id="a"/>)"));
  for (const char* weights : {"0.5", "0.5, 0.2, 0.3", "0.5 -0.5", "half half", ""})
    EXPECT_THAT(read("0.6.0", mixture(weights, red + glass)).complaints, HasSubstr("for 2 bsdfs of a 'mixturebsdf'"));
  EXPECT_THAT(read("0.6.0", R"(<bsdf type="mixturebsdf"/>)").complaints, HasSubstr("0 weights for 0 bsdfs"));
}

TEST(MitsubaUpgrade, MaterialsOfBefore03) {
  expect_same("0.2.1",
              R"(<bsdf type="microfacet"><float name="alphaB" value="0.2"/><float name="diffuseAmount" value="0.5"/>
                          <rgb name="diffuseReflectance" value="0.2 0.4 0.6"/></bsdf>)",
              R"(<bsdf type="roughplastic"><float name="alpha" value="0.2"/>
                 <rgb name="diffuse_reflectance" value="0.1 0.2 0.3"/><float name="specular_reflectance" value="1"/></bsdf>)");
  expect_same("0.2.1",
              R"(<bsdf type="ward"><float name="alphaX" value="0.2"/><float name="alphaY" value="0.3"/></bsdf>)",
              R"(<bsdf type="ward"><float name="alpha_u" value="0.2"/><float name="alpha_v" value="0.3"/></bsdf>)");
  EXPECT_THAT(read("0.2.1", R"(<bsdf type="microfacet"><float name="specularAmount" value="0.5"/>
                               <texture type="bitmap" name="specularReflectance"/></bsdf>)")
                  .complaints,
              HasSubstr("error: 'specularAmount' multiplies a texture"));
  expect_same("0.2.1", R"(<shape type="sphere"><luminaire type="area"/></shape>)",
              R"(<shape type="sphere"><emitter type="area"/><bsdf type="diffuse"/></shape>)");
}

}  // namespace
}  // namespace norrsken
